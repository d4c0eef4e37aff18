"""A library to preload: what an FMU's C++ code has deleted cannot be read or written any more."""

import os
import shutil
import subprocess
import sys

import pytest

SOURCE = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { PAGE = 4096, ROOM = 1 << 28, HEAD = 16 }; /* bytes */
static char *room, *next;

__attribute__((constructor)) static void reserve(void)
{
    room = next = mmap(NULL, ROOM, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED) _exit(97);
}

/* operator new: pages of its own for each object of an FMU's library */
void *_Znwm(size_t size)
{
    size_t bytes = (size + HEAD + PAGE - 1) / PAGE * PAGE;
    char *pages;
    Dl_info caller;
    if (!dladdr(__builtin_return_address(0), &caller) || !strstr(caller.dli_fname, "/binaries/linux64/"))
        return malloc(size);
    pages = __atomic_fetch_add(&next, bytes, __ATOMIC_RELAXED);
    if (pages + bytes > room + ROOM || mprotect(pages, bytes, PROT_READ | PROT_WRITE)) _exit(97);
    memcpy(pages, &bytes, sizeof bytes);
    return pages + HEAD;
}

/* operator delete: nobody may touch these pages from here on */
void _ZdlPv(void *object)
{
    char *pages = (char *)object - HEAD;
    size_t bytes;
    if (!((char *)object >= room && (char *)object < room + ROOM)) {
        free(object);
        return;
    }
    memcpy(&bytes, pages, sizeof bytes);
    mprotect(pages, bytes, PROT_NONE);
}

void _ZdlPvm(void *object, size_t size)
{
    (void)size;
    _ZdlPv(object);
}
"""


def fence(folder, *others):
    """Environment with the library compiled into ``folder`` and preloaded, after ``others``."""
    compiler = shutil.which("cc")
    if not sys.platform.startswith("linux") or compiler is None:
        pytest.skip("needs linux and a C compiler")
    source, library = folder / "fence.c", folder / "fence.so"
    source.write_text(SOURCE)
    command = [compiler, "-shared", "-fPIC", str(source), "-o", str(library), "-ldl"]
    subprocess.run(command, check=True, timeout=600)
    return {**os.environ, "LD_PRELOAD": os.pathsep.join([*map(str, others), str(library)])}
