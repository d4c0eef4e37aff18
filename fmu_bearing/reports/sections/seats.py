"""What the fits of the rings do: from the drawing to speed, and over their tolerances."""

from fmu_bearing.design.fit_table import STATE_COLUMNS, fit_rows, head, state_rows
from fmu_bearing.design.fits import fits
from fmu_bearing.instance import EngineError
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Absent, Block, Section, Table


def seats(subject: Subject) -> Section:
    """Show two tables per bearing of a scene with fits, at the speed of the run."""
    try:
        study = fits(subject.at_speed)
    except EngineError as problem:
        raise Absent(f"no equilibrium at a limit of the fits: {problem}") from None
    assert study.scene.fit is not None
    take = study.scene.fit.take
    blocks: list[Block] = []
    for bearing in study.column(take).bearings:
        name = f"bearing {bearing.number}: " if subject.several else ""
        words = f"{name}{study.words(bearing.number)}"
        blocks.append(Table(f"Fits at {take}, {words}", STATE_COLUMNS, state_rows(bearing)))
        note = " ".join(f"{line[0].upper()}{line[1:]}." for line in study.remarks)
        caption = f"Fits over their tolerances, {words}; each column is computed in full"
        blocks.append(Table(caption, head(study), fit_rows(study, bearing.number), note=note, folded=True))
    return Section("fits", "Fits of the rings", blocks)
