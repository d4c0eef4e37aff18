"""The seals of a bearing."""

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from fmu_bearing.formulas import seals
from fmu_bearing.scene.base import Conflict, Part


class Seal(Part):
    """Seals that sit in the outer ring and whose lips rub on the inner one: friction alone."""

    kind: seals.Kind | None = Field(
        default=None, examples=["RSH"],
        description="SKF's seal, whose formula gives the torque: RZ does not touch, RSL hardly, RSH and RS1 "
        "do; absent: torque_N_mm gives it.",
    )  # fmt: skip
    sides: Literal[1, 2] = Field(
        default=2, examples=[2], description="Seals of the kind: 2 on both sides, 1 on one."
    )
    lip_diameter_mm: float | None = Field(
        default=None, ge=1, le=1500, examples=[31.8],
        description="Diameter on which the lips rub, d_1 or d_2 in catalogues; absent: by bore and outside "
        "diameter (assumed), mm.",
    )  # fmt: skip
    torque_N_mm: float | None = Field(
        default=None, ge=0, le=1e6, examples=[69.2],
        description="Torque of all seals together, in place of the kind's formula, N mm.",
    )  # fmt: skip

    def conflicts(self) -> Iterator[Conflict]:
        """Yield a seal of which nothing is known."""
        if self.kind is None and self.torque_N_mm is None:
            names = ", ".join(seals.KINDS)
            yield Conflict("kind", f"or torque_N_mm must be given: {names}, or the torque of all seals")

    def row(self, deep_groove: bool, outside: float) -> seals.Row | None:
        """Return the row of SKF's table for a bearing of this outside diameter (mm); None: there is none."""
        return None if self.kind is None else seals.row(self.kind, deep_groove, outside)

    def lip(self, deep_groove: bool, bore: float, outside: float) -> float | None:
        """Return the diameter (mm) on which the lips rub in a bearing; None where nothing says."""
        one = self.row(deep_groove, outside)
        if self.lip_diameter_mm is not None or one is None:
            return self.lip_diameter_mm
        return seals.lip_diameter(one, bore, outside)

    def torque(self, deep_groove: bool, bore: float, outside: float) -> float:
        """Return the torque (N mm) of all seals of a bearing while it turns."""
        if self.torque_N_mm is not None:
            return self.torque_N_mm
        one, lip = self.row(deep_groove, outside), self.lip(deep_groove, bore, outside)
        return 0.0 if one is None or lip is None else seals.torque(one, lip, self.sides)

    def misfits(self, deep_groove: bool, bore: float, outside: float) -> Iterator[Conflict]:
        """Yield what does not fit a bearing of these diameters (mm), with keys as of its table."""
        if self.lip_diameter_mm is not None and not bore < self.lip_diameter_mm < outside:
            between = f"bore_mm = {bore:g} and outside_diameter_mm = {outside:g}"
            yield Conflict("seal.lip_diameter_mm", f"must lie between {between}")
        if self.kind is None or self.torque_N_mm is not None or self.row(deep_groove, outside) is not None:
            return
        bearings = f"{'deep groove' if deep_groove else 'angular contact'} bearings"
        printed = seals.rows(self.kind, deep_groove)
        known = " and ".join(one for one in seals.KINDS if seals.rows(one, deep_groove))
        limits = f"for {known} there"
        if printed:
            bearings += f" of {outside:g} mm outside diameter"
            limits = f"above {printed[0].over:g} up to {printed[-1].to:g} mm"
        yield Conflict(
            "seal.kind",
            f"{self.kind} has no constants in {bearings}: SKF prints them {limits}; give seal.torque_N_mm",
        )
