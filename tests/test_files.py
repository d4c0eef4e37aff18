"""Targets of results are checked before anything is computed, and nothing is made by the check."""

import os

import pytest

from fmu_bearing.files import check_file, check_folder, whole, write_whole


def test_a_new_place_is_accepted_and_not_made(tmp_path):
    assert check_file(tmp_path / "a" / "b.csv") == tmp_path / "a" / "b.csv"
    assert check_folder(tmp_path / "a") == tmp_path / "a"
    assert not list(tmp_path.iterdir())


def test_what_is_in_the_way_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    (tmp_path / "dangling").symlink_to(tmp_path / "nowhere")
    with pytest.raises(OSError, match=r"sub cannot be written to: .*file is a file"):
        check_folder(tmp_path / "file" / "sub")
    with pytest.raises(OSError, match="is a file; name another folder"):
        check_file(tmp_path / "file" / "a.csv")
    with pytest.raises(OSError, match="is a folder: name the file"):
        check_file(tmp_path)
    with pytest.raises(OSError, match="a link to nothing"):
        check_folder(tmp_path / "dangling" / "sub")


def test_a_file_is_written_whole_or_stays_as_it_was(tmp_path):
    (tmp_path / "a").write_text("old")
    with pytest.raises(ValueError, match="midway"), whole(tmp_path / "a") as file:
        file.write(b"half")
        raise ValueError("midway")
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("a", "old")]
    with whole(tmp_path / "new" / "b") as file:
        file.write(b"all")
    assert (tmp_path / "new" / "b").read_bytes() == b"all"


def test_a_pipe_is_not_replaced(tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")
    with pytest.raises(OSError, match=r"pipe.csv is a pipe or a device, which a file would replace"):
        check_file(tmp_path / "pipe.csv")
    with pytest.raises(OSError, match=r"pipe.csv is not a plain file: name another one to write"):
        write_whole(tmp_path / "pipe.csv", b"")
    assert (tmp_path / "pipe.csv").is_fifo() and len(list(tmp_path.iterdir())) == 1


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="the super-user writes anywhere")
def test_a_folder_without_permission(tmp_path):
    tmp_path.chmod(0o500)
    try:
        with pytest.raises(OSError, match="cannot be written to: Permission denied"):
            check_folder(tmp_path / "sub")
    finally:
        tmp_path.chmod(0o700)
