"""Scenes that sound alike share their sound block."""

from fmu_bearing.scene import Scene


def sound_key(scene: Scene) -> str:
    """Tell what a scene's sound block depends on; empty without sound.

    Speed, loads, oil, springs and imperfections are not among it: a sweep over those solves the sound once.
    """
    # slow to load, and the command line has other uses of the modules that import this one
    from fmu_bearing.acoustics.stream import radiators_of

    if scene.sound is None:
        return ""
    flexure = scene.mounting.flexure
    bending = (flexure, scene.materials, scene.bearing) if flexure is not None else ()
    return repr((scene.sound, radiators_of(scene), scene.fidelity.ball_harmonics, bending))
