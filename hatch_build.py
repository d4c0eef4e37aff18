"""What a wheel for one platform holds besides the package: kernels compiled before, and a tag that says so.

``make wheels`` fills a folder per platform (``python -m fmu_bearing.fmi.native.prebuilt``) and names it in
``FMU_BEARING_PREBUILT``. Without it the wheel is a universal one, whose kernels are compiled on first use.
"""

import os
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class PrebuiltHook(BuildHookInterface):
    """Puts compiled kernels into a wheel."""

    def initialize(self, version, build_data):
        """Add the folder of one platform."""
        folder = os.environ.get("FMU_BEARING_PREBUILT")
        if not folder or self.target_name != "wheel" or version == "editable":
            return
        build_data["force_include"][folder] = "fmu_bearing/compiled/prebuilt"
        build_data["tag"] = (Path(folder) / "tag").read_text(encoding="ascii").strip()
        build_data["pure_python"] = False
