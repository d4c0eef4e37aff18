"""The careless host of ``fuzz/``: compiled with the shim, and let loose."""

import subprocess

from . import toy

DRIVER = sorted(map(str, (toy.HERE / "fuzz").glob("*.c")))
DRIVER.remove(KERNEL := str(toy.HERE / "fuzz" / "kernel.c"))
#: Instruction sets of the kernels of this machine.
SETS = ("v2", "v3") if toy.IS_X86 else ("base",)


def build(folder, compiler, kernels, digest, *options, shim=toy.SHIM, sets=SETS):
    """Compile driver and shim with options, and link them with kernels."""
    program = folder / "fuzz"
    sources = [*DRIVER, *sorted(map(str, shim.glob("*.c")))]
    flags = [*toy.WARNINGS, *options, f"-I{toy.HEADERS}", f"-I{shim}", f'-DFB_KERNELS="{digest}"']
    flags += ["-DFB_X86"] if len(sets) > 1 else []
    toy.run([*compiler, *flags, *sources, *map(str, kernels), "-o", str(program), "-lm"])
    return program


def hostile_kernels(folder, compiler, *options, sets=SETS):
    """Objects of the kernels that use every number they are given."""
    objects = []
    for isa in sets:
        objects.append(folder / f"kernel_{isa}.o")
        command = [*compiler, *toy.WARNINGS, *options, f"-DISA={isa}", "-c", KERNEL, "-o", str(objects[-1])]
        toy.run(command)
    return objects


def play(
    program,
    good,
    bad,
    seed,
    rounds,
    *,
    guid=toy.GUID,
    count=17,
    step=0.1,
    forge=True,
    seconds=60,
    emulator=(),
):
    """Let the host call for some rounds; counts of what happened."""
    bad.mkdir(exist_ok=True)
    arguments = [guid, good, bad, count, step, int(forge), seed, rounds]
    done = subprocess.run(
        [*emulator, program, *map(str, arguments)],
        capture_output=True,
        text=True,
        errors="replace",
        timeout=seconds,
    )
    assert done.returncode == 0, (arguments, done.stdout[-2000:], done.stderr[-4000:])
    return {name: int(number) for name, number in (pair.split("=") for pair in done.stdout.split())}
