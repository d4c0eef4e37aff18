"""What shared libraries export and ask for, read from their bytes: ELF, PE and Mach-O of 64 bits."""

import struct
from dataclasses import dataclass, field


@dataclass
class Library:
    """What the loader sees.

    Attributes
    ----------
    machine : str
        ``x86-64`` or ``aarch64``.
    exports, imports : set of str
        Names others can ask for; names that other libraries must have.
    needed : set of str
        Libraries asked for.
    versions : set of str
        Versions of symbols asked for (ELF).
    name : str
        What the library calls itself.
    signed : bool
        Whether it carries a signature (Mach-O).
    """

    machine: str
    exports: set[str] = field(default_factory=set)
    imports: set[str] = field(default_factory=set)
    needed: set[str] = field(default_factory=set)
    versions: set[str] = field(default_factory=set)
    name: str = ""
    signed: bool = False


def read(data):
    """Read a library of any of the three formats."""
    if data[:4] == b"\x7fELF":
        return _elf(data)
    if data[:2] == b"MZ":
        return _pe(data)
    if data[:4] == b"\xcf\xfa\xed\xfe":
        return _macho(data)
    raise ValueError("neither ELF nor PE nor Mach-O of 64 bits")


def object_format(data):
    """Format (``ELF``, ``COFF``, ``Mach-O``) and processor of an object file, which is not linked yet."""
    if data[:4] == b"\x7fELF":
        kind, machine = struct.unpack_from("<2H", data, 16)
        found, relocatable = ("ELF", {62: "x86-64", 183: "aarch64"}[machine]), kind == 1
    elif data[:4] == b"\xcf\xfa\xed\xfe":
        machine, _, kind = struct.unpack_from("<3I", data, 4)
        found, relocatable = ("Mach-O", {0x01000007: "x86-64", 0x0100000C: "aarch64"}[machine]), kind == 1
    else:
        machine, _, _, _, _, optional, _ = struct.unpack_from("<2H3I2H", data)
        found, relocatable = ("COFF", {0x8664: "x86-64", 0xAA64: "aarch64"}[machine]), optional == 0
    if not relocatable:
        raise ValueError("not an object file")
    return found


def _text(data, at):
    return data[at : data.index(b"\0", at)].decode()


# --- ELF ----------------------------------------------------------------------------------------------
_DYNAMIC, _DYNSYM, _VERNEED = 6, 11, 0x6FFFFFFE
_NEEDED, _SONAME = 1, 14
_WEAK = 2


def _elf(data):
    machine = {62: "x86-64", 183: "aarch64"}[struct.unpack_from("<H", data, 18)[0]]
    (table,) = struct.unpack_from("<Q", data, 40)
    size, count = struct.unpack_from("<2H", data, 58)
    # name, type, flags, address, offset, size, link, info, alignment, size of an entry
    sections = [struct.unpack_from("<2I4Q2I2Q", data, table + i * size) for i in range(count)]
    found = Library(machine)
    for section in sections:
        kind, begin, length = section[1], section[4], section[5]
        strings = sections[section[6]][4] if section[6] < count else 0
        if kind == _DYNSYM:
            _elf_symbols(data, begin, length, strings, found)
        elif kind == _VERNEED:
            _elf_versions(data, begin, strings, found)
        elif kind == _DYNAMIC:
            for tag, value in struct.iter_unpack("<2Q", data[begin : begin + length]):
                if tag == _NEEDED:
                    found.needed.add(_text(data, strings + value))
                elif tag == _SONAME:
                    found.name = _text(data, strings + value)
    return found


def _elf_symbols(data, begin, length, strings, found):
    for at in range(begin + 24, begin + length, 24):
        name, info, _, section = struct.unpack_from("<I2BH", data, at)
        if section:
            found.exports.add(_text(data, strings + name))
        elif info >> 4 != _WEAK:  # a weak one need not be there
            found.imports.add(_text(data, strings + name))


def _elf_versions(data, at, strings, found):
    while True:
        _, count, _, first, following = struct.unpack_from("<2H3I", data, at)
        one = at + first
        for _ in range(count):
            _, _, _, name, step = struct.unpack_from("<I2H2I", data, one)
            found.versions.add(_text(data, strings + name))
            one += step
        if not following:
            return
        at += following


# --- PE -----------------------------------------------------------------------------------------------
def _pe(data):
    (head,) = struct.unpack_from("<I", data, 0x3C)
    machine, sections, _, _, _, optional = struct.unpack_from("<2H3IH", data, head + 4)
    first = head + 24 + optional
    areas = [struct.unpack_from("<4I", data, first + 40 * i + 8) for i in range(sections)]

    def place(address):
        for size, begin, stored, at in areas:
            if begin <= address < begin + max(size, stored):
                return at + address - begin
        raise ValueError(f"no section holds address {address:#x}")

    found = Library({0x8664: "x86-64", 0xAA64: "aarch64"}[machine])
    exports, _, imports, _ = struct.unpack_from("<4I", data, head + 24 + 112)
    at = place(exports)
    found.name = _text(data, place(struct.unpack_from("<I", data, at + 12)[0]))
    count, _, names = struct.unpack_from("<3I", data, at + 24)
    for address in struct.unpack_from(f"<{count}I", data, place(names)):
        found.exports.add(_text(data, place(address)))
    at = place(imports)
    while any(entry := struct.unpack_from("<5I", data, at)):
        found.needed.add(_text(data, place(entry[3])))
        thunk = place(entry[0] or entry[4])
        while hint := struct.unpack_from("<Q", data, thunk)[0]:
            found.imports.add(_text(data, place(hint) + 2) if hint >> 63 == 0 else f"#{hint & 0xFFFF}")
            thunk += 8
        at += 20
    return found


# --- Mach-O -------------------------------------------------------------------------------------------
_SYMBOLS, _LOAD, _ID, _SIGNATURE = 0x2, 0xC, 0xD, 0x1D
_EXTERNAL, _PRIVATE, _KIND = 0x01, 0x10, 0x0E


def _macho(data):
    kind, _, _, count = struct.unpack_from("<4I", data, 4)
    found = Library({0x01000007: "x86-64", 0x0100000C: "aarch64"}[kind])
    at = 32
    for _ in range(count):
        command, size = struct.unpack_from("<2I", data, at)
        if command in (_LOAD, _ID):
            name = _text(data, at + struct.unpack_from("<I", data, at + 8)[0])
            if command == _LOAD:
                found.needed.add(name)
            else:
                found.name = name
        elif command == _SYMBOLS:
            symbols, many, strings, _ = struct.unpack_from("<4I", data, at + 8)
            for i in range(many):
                name, info, _, _, _ = struct.unpack_from("<I2BHQ", data, symbols + 16 * i)
                if info & _EXTERNAL and not info & _PRIVATE:
                    names = found.exports if info & _KIND else found.imports
                    names.add(_text(data, strings + name).removeprefix("_"))
        elif command == _SIGNATURE:
            found.signed = True
        at += size
    return found
