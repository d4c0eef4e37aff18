"""Speed and temperatures at the start."""

from pydantic import Field

from fmu_bearing.scene.base import Part

#: r/min: of the smallest bearing that a scene may have; that of a scene is `Bearing.most_speed`.
_MOST = 1.3e6


class Operation(Part):
    """Speed and temperatures at the start; all are inputs of the FMU, with the same ranges."""

    speed_rpm: float = Field(
        ge=-_MOST, le=_MOST, examples=[20000.0],
        description="Shaft speed, right-handed about +X; up to 2.6e6 mm r/min over the pitch diameter, "
        "100000 r/min at least, r/min.",
    )  # fmt: skip
    lowest_speed_rpm: float | None = Field(
        default=None,
        ge=10,
        le=_MOST,
        examples=[3000.0],
        description=(
            "Lowest speed of a run-up, to which imperfections.highest_frequency_kHz refers; absent: the "
            "amount of speed_rpm, r/min."
        ),
    )
    oil_temperature_degC: float = Field(
        default=40.0, ge=-40, le=199, examples=[40.0],
        description="Temperature that sets the oil's viscosity, degC.",
    )  # fmt: skip
    inner_ring_temperature_degC: float = Field(
        default=40.0, ge=-40, le=199, examples=[40.0], description="Temperature of the inner ring, degC."
    )
    outer_ring_temperature_degC: float = Field(
        default=40.0, ge=-40, le=199, examples=[40.0], description="Temperature of the outer ring, degC."
    )
    required_life_h: float | None = Field(
        default=None, ge=1, le=1e7, examples=[20000.0],
        description="Rating life asked of the bearing, of a set and each of its bearings, for verdicts alone "
        "(absent: 20,000 h, assumed), h.",
    )  # fmt: skip
