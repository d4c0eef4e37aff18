"""What all parts of a scene share: frozen, no unknown keys, finite numbers only."""

from pydantic import BaseModel, ConfigDict


class Part(BaseModel):
    """One table of a scene file."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
