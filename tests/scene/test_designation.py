"""Misspelt and short names: which entries of a catalogue are suggested."""

import pytest

from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.designation import ANGULAR, read_designation, suggestion
from fmu_bearing.scene.entries import entries
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.own_bearing import Dimensions
from fmu_bearing.scene.read import read_scene_text
from fmu_bearing.scene.symbols import CERAMIC, SOURCES, STEEL, SYMBOLS
from fmu_bearing.scene.template import new_scene
from tests.messages import says
from tests.pages import DOCS

WAY = (
    "give its dimensions, `fmu-bearing scene new --bore {} --outside-diameter {} --width {} "
    "--contact-angle {}`, and for its own balls the maker's C and C0 (N) by --dynamic-rating and "
    "--static-rating; "
)


@pytest.mark.parametrize(
    ("wanted", "kind"),
    [
        ("4205", "a double-row deep groove ball bearing"),
        ("NU210", "a cylindrical roller bearing"),
        ("NU 210 ECP", "a cylindrical roller bearing"),
        ("N1010", "a cylindrical roller bearing"),
        ("30206", "a tapered roller bearing"),
        ("22210 E", "a spherical roller bearing"),
        ("1205", "a self-aligning ball bearing"),
        ("51105", "a thrust ball bearing"),
        ("QJ 210", "a four-point contact ball bearing"),
        ("NA4910", "a needle roller bearing"),
        ("3205 A", "a double-row angular contact ball bearing"),
        ("7602025TN1", "a bearing for screws, of 60 deg"),
    ],
)
def test_other_kinds_of_bearings_are_named(wanted, kind):
    words = (
        f"it is {kind}, which is not modelled: single-row angular contact and deep groove ball bearings are; "
    )
    assert suggestion(wanted, entries("bearings")) == words
    # a user's own catalogue may have such a name
    assert suggestion(wanted, [wanted.lower(), "7003C"]) != words


@pytest.mark.parametrize(
    ("wanted", "name"),
    [
        ("SKF 6309-2Z", "6309"),
        ("6205-2RS", "6205"),
        ("6006zz C3", "6006"),
        ("608", ""),
        ("16005", ""),
        ("61805", ""),
    ],
)
def test_deep_groove_bearings_by_their_figures(wanted, name):
    words = suggestion(wanted, entries("bearings"))
    if name:
        assert says(words, f"did you mean '{name}' ... bearing.clearance and bearing.seal")
    else:
        assert words.startswith(
            "it is a deep groove ball bearing, of which the catalogue has 60, 62 and 63 with "
        )


@pytest.mark.parametrize(
    ("wanted", "words"),
    [
        ("7010C", "did you mean 'NSK-7010C'? "),  # letters alone would say 7009C
        ("7010", "did you mean 'NSK-7010C' or 'NSK-7010AC'? "),
        ("NSK 7010 c", "did you mean 'NSK-7010C'? "),
        ("NKS-7009C", "did you mean 'NSK-7009C'? "),
        ("7009", "did you mean '7009C'? "),  # no maker is asked for
        ("7003D", "did you mean '7003C'? "),
        ("71910C", "did you mean 'NSK-7910C'? "),  # series 719 and 79 have equal dimensions
        ("7010CD/P4A", "did you mean 'NSK-7010C'? "),
        ("B7010-A5", "did you mean 'NSK-7010AC'? "),
        ("7020C", f"the nearest in size is 'NSK-7014C', or {WAY.format(100, 150, 24, 15)}"),
        ("7207C", f"it is of series 72, and the catalogue has 70 and 79 (719): {WAY.format(35, 72, 17, 15)}"),
        (
            "7305 BEA",
            f"it is of series 73, and the catalogue has 70 and 79 (719): {WAY.format(25, 62, 17, 40)}",
        ),
        (
            "71807AC",
            f"it is of series 718, and the catalogue has 70 and 79 (719): {WAY.format(35, 47, 7, 25)}",
        ),
        (
            "7414",
            f"it is of series 74, and the catalogue has 70 and 79 (719): {WAY.format(70, 'D', 'B', 'DEG')}",
        ),
        ("NSK-701C", "did you mean 'NSK-7901C'? "),  # no size in it: by letters
        ("honey", ""),
        # other makers' names of a size, by series, bore and angle
        ("VEX 50 /NS 7CE3", "did you mean 'NSK-7010AC'? "),
        ("S 6010 C TA", "did you mean 'NSK-7010C'? "),
        ("B7010-E-T-P4S-UL", "did you mean 'NSK-7010AC'? "),
        ("NSK 7003 C TYN DBL P4", "did you mean 'NSK-7003C'? "),
        (
            "NTN 7010",
            "of this size with 30 deg it has none, 'NSK-7010C' or 'NSK-7010AC' is the nearest, or "
            + WAY.format(50, 80, 16, 30),
        ),
    ],
)
def test_bearings_are_suggested_by_size_and_maker(wanted, words):
    assert suggestion(wanted, entries("bearings")) == words


def test_each_size_is_found_without_its_maker():
    """Of the papers' sizes the papers' own bearing, which has no maker."""
    known = entries("bearings")
    for name in known.keys() & sizes().keys():
        short = name.removeprefix("NSK-")
        if short not in known:
            assert suggestion(short, known) == f"did you mean '{name}'? "


def test_other_names_are_suggested_by_their_letters():
    known = entries("materials")
    assert suggestion("si3n", known) == "did you mean 'Si3N4'? "
    assert suggestion("7010C", known) == "" == suggestion("7010C", [])
    assert suggestion("own-7008c", ["my-7008C", "7003C"]) == "did you mean 'my-7008C'? "


#: Examples of makers' catalogues: maker, bore (mm), angle (deg), balls, cage, tolerance class.
EXAMPLES = {
    "NSK-7010C": ("NSK", 50, 15, STEEL, None, None),
    "7010A5TYNSULP4": ("NSK", 50, 25, STEEL, "polyamide", "P4"),
    "7013CSN24TRDULP3": ("NSK", 65, 15, CERAMIC, "phenolic", "P4"),
    "80BNR10HTYNDBELP4": ("NSK", 80, 18, CERAMIC, "polyamide", "P4"),
    "65BER19STYN": ("NSK", 65, 25, STEEL, "polyamide", None),
    "S7014 ACD/HCP4A": ("SKF", 70, 25, CERAMIC, "phenolic", "P4"),
    "7010 CD/P4A": ("SKF", 50, 15, STEEL, "phenolic", "P4"),
    "719/7 CE/HCP4A": ("SKF", 7, 15, CERAMIC, "phenolic", "P4"),
    "71910 FE/PA9A": ("SKF", 50, 18, STEEL, "phenolic", "P2"),
    "V7014 ACE/P4A": ("SKF", 70, 25, CERAMIC, "phenolic", "P4"),
    "HCB71908-E-T-P4S": ("FAG", 40, 25, CERAMIC, "phenolic", "P4"),
    "B7010-C-T-P4S-UL": ("FAG", 50, 15, STEEL, "phenolic", "P4"),
    "HCRS7010-D-T-P4S-UL": ("FAG", 50, 20, CERAMIC, "phenolic", "P4"),
    "HCM7012-C-T": ("FAG", 60, None, CERAMIC, "phenolic", None),
    "5S-7020UCT1DB/GMP4": ("NTN", 100, 15, CERAMIC, "phenolic", "P4"),
    "7020UADG/GNP42": ("NTN", 100, 25, STEEL, None, "P4"),
    "NTN-7020DB": ("NTN", 100, 30, STEEL, None, None),
    "S 61908 E TA P4+": ("GMN", 40, 25, STEEL, "phenolic", "P4"),
    "HY S 6010 C TA": ("GMN", 50, 15, CERAMIC, "phenolic", None),
    "VEX 50 /NS 7CE3": ("SNFA", 50, 25, CERAMIC, "phenolic", "P4"),
    "SKF SEB 50 9CE1 DUL": ("SNFA", 50, 15, STEEL, "phenolic", "P2"),
    "5S-2LA-HSE010C": ("NTN", 50, 15, CERAMIC, None, None),
    "2LA-HSE910AD/GNP42": ("NTN", 50, 25, STEEL, None, "P4"),
    "5S-2LA-HSE010": ("NTN", 50, None, CERAMIC, None, None),
    "7010CT1": ("NTN", 50, 15, STEEL, "phenolic", None),
    "7310 BEP": ("SKF", 50, 40, STEEL, None, None),
    "7210 BECBM": ("SKF", 50, 40, STEEL, None, None),
    "SKF 7218 BCBM": ("SKF", 90, 40, STEEL, None, None),
    "7014 CD/P4ADGA": ("SKF", 70, 15, STEEL, "phenolic", "P4"),
    "7010 CDGA/P4A": ("SKF", 50, 15, STEEL, "phenolic", "P4"),
    "XCB7010-C-T-P4S": ("FAG", 50, 15, CERAMIC, "phenolic", "P4"),
    "HS7010C.T.P4S.UL": ("FAG", 50, 15, STEEL, "phenolic", "P4"),
    "7208-B-XL-TVP": ("FAG", 40, 40, STEEL, None, None),
    "SM 6012 C TA ABEC7": ("GMN", 60, 15, STEEL, "phenolic", "P4"),
    "HYKH 6010": ("GMN", 50, None, CERAMIC, None, None),
    "NSK 50BNR10S": ("NSK", 50, 18, STEEL, None, None),
    "30BAR10STYNDBELP3": ("NSK", 30, 30, STEEL, "polyamide", "P4"),
    "NSK7003CTYNSULP4": ("NSK", 17, 15, STEEL, "polyamide", "P4"),
    "nsk 7003 c tyn dbl p4": ("NSK", 17, 15, STEEL, "polyamide", "P4"),
    "7205BEAT85SU": ("NSK", 25, 40, STEEL, None, None),
    "NSK 7210": ("NSK", 50, 30, STEEL, None, None),
    "NSK 7206AW": ("NSK", 30, 30, STEEL, None, None),
    "7003-C": ("", 17, 15, STEEL, None, None),
    "7008C": ("", 40, 15, STEEL, None, None),
    "7010": ("", 50, None, STEEL, None, None),
}


@pytest.mark.parametrize("text", EXAMPLES)
def test_a_designation_says_angle_balls_cage_and_class(text):
    said = read_designation(text)
    assert said.kind == ANGULAR and said.text == text
    assert (said.maker, said.bore, said.angle, said.balls, said.cage, said.tolerance) == EXAMPLES[text]


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("6205", "deep groove ball bearing"), ("6205-2RS", "deep groove ball bearing"),
        ("NU210", "cylindrical roller bearing"), ("30205", "tapered roller bearing"),
        ("S6205-2RS", "deep groove ball bearing"), ("1206 K", "self-aligning ball bearing"),
        ("BSB 025062", "bearing for screws, of 60 deg"),
        ("234420 BM1", "double-direction angular contact thrust ball bearing"),
    ],
)  # fmt: skip
def test_other_kinds_are_said_and_refused(text, kind):
    assert read_designation(text).kind == kind
    other = (
        "give one of the catalogue" if kind.startswith("deep") else "and this package models angular contact"
    )
    with pytest.raises(SceneError, match=f"{text} is a {kind}[,:] {other}"):
        new_scene("a", Dimensions(25.0, 52.0, 15.0), designation=text)


#: What no table has: the part, whether the angle and the balls are asked for.
_OPEN = {
    "7010DU": ("DU", True, True),  # a seal or a set
    "7010HVDUJ74": ("HVDUJ74", True, True),  # of a maker without a table
    "7010CVDUJ74": ("VDUJ74", True, True),  # the sign of the angle may be longer
    "7010 CD/XYZ P4A": ("XYZ P4A", False, True),  # behind a sign that is read; the balls may be ceramic
    "HCB7010-C-T-XYZ": ("XYZ", False, False),  # the prefix says ceramic
    "BNR10H": ("BNR10H", True, True),  # no bore
    "HYKH 6010": ("", True, False),
    "NTN HSE010": ("", True, False),
    "7210": ("", True, False),  # NSK and NTN 30 deg, others 15 or 40
}


@pytest.mark.parametrize("text", _OPEN)
def test_what_a_designation_leaves_open_is_asked_for(text):
    part, angle, balls = _OPEN[text]
    size = Dimensions(50.0, 80.0, 16.0)
    if not angle and not balls:
        assert 'balls = "Si3N4" # FAG: HCB' in new_scene("a", size, designation=text, sound=False)
        return
    with pytest.raises(SceneError) as refused:
        new_scene("a", size, designation=text)
    words = str(refused.value)
    assert words.startswith(f"the designation {text} says no ") and words.count("\n") == 0
    assert ("--contact-angle DEG" in words, "--kind steel|hybrid" in words) == (angle, balls)
    assert (f"'{part}' is in no table" in words) == bool(part)
    given = Dimensions(50.0, 80.0, 16.0, 25.0 if angle else None)
    kind = "steel" if balls else None
    made = read_scene_text(new_scene("a", given, designation=text, kind=kind, sound=False))
    assert made.bearing.designation == text
    if angle:
        assert made.bearing.contact_angle_deg == 25.0


def test_a_bore_that_contradicts_the_designation_is_refused():
    for bearing in (Dimensions(60.0, 95.0, 18.0), "NSK-7012C"):
        with pytest.raises(SceneError, match="a bore of 60 mm: the designation 7010 CD/P4A means 50 mm"):
            new_scene("a", bearing, designation="7010 CD/P4A")


def test_an_angle_that_contradicts_the_designation_is_refused():
    with pytest.raises(
        SceneError, match="a contact angle of 15 deg, of NSK-7010C: the designation 7010AC means"
    ):
        new_scene("a", "NSK-7010C", designation="7010AC")
    assert 'designation = "7010C"' in new_scene("a", "NSK-7010C", designation="7010C", sound=False)


def test_a_name_that_names_no_size_says_nothing():
    text = new_scene("a", Dimensions(50.0, 80.0, 16.0), designation="front bearing", sound=False)
    assert "contact_angle_deg = 15.0 # assumed: no designation says" in text


@pytest.mark.parametrize("text", ["honey", "my-7008C", "", "12345", "7-11"])
def test_what_is_no_designation_says_nothing(text):
    assert read_designation(text) is None


def test_a_scene_has_what_its_designation_says():
    size = Dimensions(70.0, 110.0, 20.0)
    text = new_scene("a", size, designation="S7014 ACD/HCP2A", sound=False)
    scene = read_scene_text(text)
    assert scene.bearing.contact_angle_deg == 25.0 and scene.materials.balls.density_kg_m3 == 3200.0
    assert 'balls = "Si3N4" # SKF: HC in S7014 ACD/HCP2A, Si3N4 balls' in text and 'grade = "P2"' in text
    assert "contact_angle_deg = 25.0 # SKF: AC in S7014 ACD/HCP2A" in text
    steel = new_scene("a", "NSK-7010C", sound=False)
    assert 'balls = "GCr15" # NSK: no symbol in NSK-7010C, steel balls' in steel
    hybrid = new_scene("a", "NSK-7010C", sound=False, kind="hybrid")
    assert 'balls = "Si3N4" # as given; NSK: no symbol in NSK-7010C, steel balls' in hybrid
    # nobody says: assumed, and marked
    for bare in (new_scene("a", size, sound=False), new_scene("a", "7003C", sound=False)):
        assert 'balls = "Si3N4" # assumed: no designation says; steel ones are GCr15' in bare
    assert "contact_angle_deg = 15.0 # assumed: no designation says" in new_scene("a", size, sound=False)


def test_a_contradiction_is_refused_and_a_gap_is_asked_for():
    with pytest.raises(SceneError, match=r"contact angle 15 deg: SKF: AC in S7014 ACD/HCP4A means 25 deg"):
        new_scene("a", Dimensions(70.0, 110.0, 20.0, 15.0), designation="S7014 ACD/HCP4A")
    with pytest.raises(SceneError, match=r"HCM7012-C-T says no contact angle that is known: give it"):
        new_scene("a", Dimensions(60.0, 95.0, 18.0), designation="HCM7012-C-T")
    new_scene("a", Dimensions(60.0, 95.0, 18.0, 17.0), designation="HCM7012-C-T")


@pytest.mark.pages
def test_the_page_has_every_symbol():
    rows = {}
    for line in (DOCS / "catalogue.md").read_text("utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if cells[0] in SOURCES and len(cells) == 5:
            rows[cells[0]] = cells[1:]
    assert rows.keys() == SOURCES.keys()
    for one in SYMBOLS:
        cells = rows[one.maker]
        if one.field == "angle":
            assert f"{one.text or 'no sign'} {one.value:g}" in cells[0] or one.text in cells[0], one
        elif one.field == "balls":
            assert one.text in cells[1 if one.value == STEEL else 2], one
        else:
            assert one.text in cells[3] and str(one.value) in cells[3], one
