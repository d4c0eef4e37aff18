"""What a distribution holds besides the package's files.

A wheel for one platform brings compiled kernels and a tag that says so. ``make wheels`` fills a folder per
platform (``python -m fmu_bearing.fmi.native.prebuilt``) and names it in ``FMU_BEARING_PREBUILT``. Without it
the wheel is a universal one, whose kernels are compiled on first use.

Links to the project are made of the address of its repository in ``FMU_BEARING_URL``, which the workflow of
releases sets; those of the README then lead to the files of the version there. Without it a distribution has
no links to the project, because no address would be true.
"""

import os
import re
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

#: Links of the project by label: what follows the address of its repository.
LINKS = {"Source": "", "Issues": "/issues", "Releases": "/releases"}


class LinksHook(MetadataHookInterface):
    """Puts the README and links to the project into the metadata."""

    def update(self, metadata):
        """Add the links of the address."""
        address = os.environ.get("FMU_BEARING_URL", "").rstrip("/")
        text = (Path(__file__).parent / "README.md").read_text(encoding="utf-8")
        metadata["urls"] = {label: address + end for label, end in LINKS.items()} if address else {}
        if address:
            for kind, link in (("raw", r"!\[[^\]]*\]\("), ("blob", r"(?<!!)\[[^\[\]]*\]\(")):
                place = f"{address}/{kind}/v{metadata['version']}/"
                text = re.sub(rf"({link})(?![a-z]+:|#)", rf"\1{place}", text)
        metadata["readme"] = {"content-type": "text/markdown", "text": text}


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
