"""Friction torque, where it comes from, and where its heat goes."""

from fmu_bearing.design.heat import ARISES, GOES, heat_table
from fmu_bearing.design.torque_range import CAPTION
from fmu_bearing.instance import EngineError
from fmu_bearing.reports.data.curves import curve, curve_words, last_turns
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Block, Chart, Section, Table, Words

_SHARES = {
    "contacts": (ARISES["sliding"], "inner_ring"),
    "rolling": (ARISES["rolling"], "outer_ring"),
    "cage": (ARISES["cage"], "cage"),
    "drag": (ARISES["drag"], "balls"),
    "seals": (ARISES["seals"], "mark"),
}
_HEATS = {
    "inner_ring": (GOES["inner_ring"], "inner_ring"),
    "outer_ring": (GOES["outer_ring"], "outer_ring"),
    "oil": (GOES["oil"], "balls"),
}


def friction(subject: Subject) -> Section:
    """Torque and heat over time, their means and shares."""
    torque = 1e3 * subject.mean("friction_torque")  # says what is missing
    names = {"friction_torque": ("torque taken from the shaft", "total")}
    names |= {f"friction_torque_share.{key}": value for key, value in _SHARES.items()}
    blocks: list[Block] = [
        _over_time(
            subject, "torque", "Friction torque and its shares", names, "N mm",
            f"Friction torque over time, {torque:.3g} N mm in the mean, and its shares by source.",
            "A share is the power lost there over the shaft speed. The torque taken from the shaft also "
            "stores and gives back energy, so it varies about the shares' sum.",
        )
    ]  # fmt: skip
    names = {f"heat.{key}": value for key, value in _HEATS.items()}
    if subject.has(*names):
        total = sum(subject.mean(name) for name in names)
        seals = "what seals lose the inner ring, " if subject.has("friction_torque_share.seals") else ""
        chart = _over_time(
            subject, "heat", "Heat by where it goes", names, "W",
            f"Heat to inner ring, outer ring and oil over time; {total:.3g} W in all in the mean.",
            f"Means over each communication step. Half of what a contact loses heats its ring, {seals}all "
            "else goes to oil and balls.",
        )  # fmt: skip
        blocks.append(chart)
    blocks += [_table(subject), *_settled(subject)]
    if subject.fidelity in ("rings", "response"):
        words = f"With fidelity {subject.fidelity}, torque and heats are computed for the steady state "
        blocks.append(Words(f"{words}at the present inputs.", "note"))
    return Section("friction", "Friction and heat", blocks)


def _over_time(
    subject: Subject, key: str, title: str, names: dict[str, tuple[str, str]], unit: str, words: str,
    note: str,
) -> Chart:  # fmt: skip
    """Draw variables, given with words and colour, over time."""
    figure, torque = look.figure(height=350), unit == "N mm"
    for name, (entry, tint) in names.items():
        try:
            values = (1e3 if torque else 1.0) * subject.whole(name)
        except Absent:
            continue
        for part in curve(subject, values, entry):
            figure.add_scatter(
                **part, line={"color": look.colour(tint), "width": 1.3},
                hovertemplate="%{x:.4f} s: %{y:.3f} " + unit + "<extra>%{fullData.name}</extra>",
            )  # fmt: skip
    window, more = last_turns(subject), {} if torque else {"rangemode": "tozero"}
    figure.update_layout(
        xaxis=look.axis("time after initialisation, s", range=window.options[0].layout["xaxis.range"]),
        yaxis=look.axis(f"{key}, {unit}", **more),
    )
    return Chart(key, title, figure, words, (window,), note=f"{note} {curve_words(subject)}")


def _settled(subject: Subject) -> list[Block]:
    """Torque and heat of the settled bearings with their ranges, and the inputs of these at their ends."""
    try:
        point = subject.point
        ranges = point.torque_range
    except (Absent, EngineError):
        return []
    caption, note = "Friction and heat of the settled bearings, without waviness", "The changes are added as "
    note += "roots of squares, upwards and downwards apart."
    (columns, rows), inputs = heat_table(point.bearings, ranges), ranges.table()
    return [Table(caption, columns, rows), Table(f"{CAPTION[0].upper()}{CAPTION[1:]}", *inputs, note=note)]


def _table(subject: Subject) -> Table:
    rows, shares = [], {}
    for key in _SHARES:
        try:
            shares[key] = float(subject.whole(f"friction_torque_share.{key}").mean())
        except Absent:
            continue
    whole = sum(shares.values())

    def add(words: str, torque: float, share: str = "") -> None:
        rows.append([words, f"{1e3 * torque:.3f}", f"{abs(torque * subject.speed):.3f}", share])

    for key, value in shares.items():
        add(_SHARES[key][0], value, f"{100.0 * value / whole:.1f}" if whole else "")
    if shares:
        add("all shares", whole, "100.0" if whole else "")
    add("torque taken from the shaft", subject.mean("friction_torque"))
    for words, prefix in subject.prefixes.items():
        if subject.has(f"{prefix}friction_torque") and words:
            add(f"of it by {words}", subject.mean(f"{prefix}friction_torque"))
    for key, (words, _) in _HEATS.items():
        if subject.has(f"heat.{key}"):
            rows.append([f"heat to {words}", "", f"{subject.mean(f'heat.{key}'):.3f}", ""])
    return Table(
        "Friction and heat, means over the recording", ["", "torque, N mm", "power, W", "share, %"], rows
    )
