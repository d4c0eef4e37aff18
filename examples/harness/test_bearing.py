"""Test harness of a bearing FMU: it runs, matches the accepted reference, and stays within limits.

Run it from this folder or from any other::

    pytest examples/harness --fmu out/Bearing7003C.fmu     (or --fmu examples/scenes/7003C-spindle.toml)
    pytest examples/harness --fmu ... --record-references  (after an intended change)

Shows: a run within tolerances of a recorded reference (51 points of 8 variables at the start of the 7003C in
its spindle), and limits chosen by the user on friction and heat. The fixtures come with fmu-bearing; no
plugin has to be named.
"""


def test_start_is_as_recorded(bearing_fmu, start, assert_matches_reference):
    """The start is the recorded one."""
    # velocities to 1e-4 of their largest, all else to the usual 1e-5
    run = assert_matches_reference(bearing_fmu, "references/start.csv", start, rtol={"m/s": 1e-4})
    assert len(run) == 51


def test_heat_is_what_friction_takes(bearing_fmu, start, step_fmu):
    """Friction and heat are what drive and cooling can spare."""
    run = step_fmu(bearing_fmu, start)
    heat = sum(run[name] for name in ("heat.inner_ring", "heat.outer_ring", "heat.oil"))
    assert 0.0 < run["friction_torque"].mean() < 0.05  # N m, what the drive can spare
    assert heat[1:].mean() < 100.0  # W, what the spindle's cooling takes
