"""The data card of a set: what it holds, how it was drawn, what was assumed, licence."""

from collections import Counter
from collections.abc import Mapping

from fmu_bearing.dataset.draw import words
from fmu_bearing.dataset.layout import Layout
from fmu_bearing.results.table import markdown
from fmu_bearing.sweeps.runs import Outcomes

_ASSUMED = (
    "All waveforms are computed; none is measured. A class names what the model was given, not what a person "
    "found in a bearing.",
    "Each run is a scene of its own from its steady state, at constant speed and load, without transducer "
    "noise, mains hum, gears, belts or other machines, unless the scene has them.",
    "Frequencies in the labels are those of the run: cage and balls as they turned in its mean, not those of "
    "rolling at the nominal contact angle.",
    "A defect has a fixed shape. Plastic rims, debris, growth under load and lubricant in the pit are left "
    "out.",
    "What the seat, the housing and the path to a sensor do is what the scene says of them; levels of "
    "another machine differ. Limits of the model: page "
    '"What it does not do" of the documentation.',
)


def card(layout: Layout, outcomes: Outcomes, versions: Mapping[str, str]) -> str:
    """Return the data card as Markdown; it holds no date, so that equal sets have equal cards."""
    plan, scene = layout.plan, layout.scene
    done = [outcomes.get(task.key) for task in layout.tasks]
    whole = sum(one is not None and not one.reason for one in done)
    classes = Counter(run.label for run in layout.runs)
    rows = [
        [one.name, str(classes[one.name]), f"{one.share:g}", "; ".join(draws) or "as in the scene"]
        for one, draws in words(plan, scene)
    ]
    fidelities = ", ".join(sorted({task.scene.fidelity.model for task in layout.tasks}))
    reasons = sorted({one.reason for one in done if one is not None and one.reason})
    parts = [
        f"# {plan.title or 'Labelled waveforms of ' + scene.name}",
        f"{len(layout.tasks)} runs of {plan.length_s:g} s at {plan.rate_Hz:,} Hz after {plan.settle_s:g} s, "
        f"fidelity {fidelities}; {whole} of them have waveforms. Made by `fmu-bearing dataset` "
        f"{versions['fmu_bearing']} (engine {versions['engine']}, code {versions['code']}).",
        *(["Without waveforms: " + "; ".join(reasons) + "."] if reasons else []),
        "## Files",
        markdown(["file", "content"], [
            ["`waveforms.nc`", "netCDF-4 (HDF5): `waveforms` (run, sensor, sample), float32; `time` (s), "
             "`sensor`, `unit`, `class`, and the `scene` of each run as TOML"],
            ["`labels.csv`", "a row per run: class, values of its scene under their dotted keys in the key's "
             "unit, frequencies (Hz), rms, peak, kurtosis, restarts of the solver, version, reason"],
            ["`plan.toml`, `scene.toml`", "`fmu-bearing dataset plan.toml -o FOLDER` makes the set again"],
            ["`runs/`", "each run by itself, from which the same command goes on"],
        ]),
        "## Sensors",
        markdown(["sensor", "unit"], [[name, unit] for name, unit in layout.sensors.items()]),
        "Linear phase, flat to 0.4 of the rate; what lies above half of it is 90 dB down.",
        "## Classes",
        f"Drawn with seed {plan.seed} by a Latin hypercube for each class; the shapes of its defects are "
        f"{plan.sizes} at most. Runs are in random order.",
        markdown(["class", "runs", "share", "drawn"], rows),
        *layout.notes,
        "## Assumptions",
        "\n".join(f"- {line}" for line in _ASSUMED),
        "## Licence",
        plan.licence,
    ]  # fmt: skip
    return "\n\n".join(parts) + "\n"
