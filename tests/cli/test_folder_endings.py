"""A folder's name does not end as a file's: what cannot be written is refused, not made a folder of."""

import pytest

from fmu_bearing.files import check_file, check_folder


@pytest.mark.parametrize("command", ["sound", "sensitivity", "modes", "error-motion"])
def test_an_unknown_ending_is_refused(run, silent_file, tmp_path, command):
    refused = run(command, silent_file, "-o", tmp_path / "out.uff")
    assert refused.exit_code == 2 and refused.stderr.count("\n") == 1
    assert (
        f"out.uff: a folder is written here, and .uff is the ending of a file: name a folder, as {tmp_path}"
        in (refused.stderr)
    )
    assert not (tmp_path / "out.uff").exists()


def test_folders_that_are_there_or_have_other_dots_are_taken(tmp_path):
    (tmp_path / "old.csv").mkdir()
    for name in ("old.csv", "v1.2", "a.results", "plain"):
        assert check_folder(tmp_path / name) == tmp_path / name
    # a file may lie in any folder
    assert check_file(tmp_path / "new.uff" / "a.csv") == tmp_path / "new.uff" / "a.csv"
