"""Traction laws against a slow version in mpmath, against dense quadrature, and in their limits."""

import mpmath as mp
import numpy as np
import pytest

from fmu_bearing.engine.layout import STRIDE, C, P, R, W
from fmu_bearing.engine.mechanics.race import traction
from fmu_bearing.engine.mechanics.traction import heated_share, lubricated_traction, warming
from fmu_bearing.prepare.model import pack
from tests.engine.helpers import RPM, quiet
from tests.engine.lubrication import film_places
from tests.oracles.friction import film_heat, flash, slid_share

ETA = 0.03  # Pa s, ambient
CONDUCTIVITY, EFFUSIVITY = 0.14, 12.8e3  # W/(m K) of oil, W s^0.5/(m2 K) of steel
SUMS = (R.FT, R.FM, R.MN, R.MT, R.MM)


class Contact:
    """Rows of the work space as ``race.normal_contact`` leaves them, one contact per lane."""

    def __init__(self, scene, law, strips=5):
        one = quiet(scene("7003C-spindle"))
        one = one.model_copy(update={"fidelity": one.fidelity.model_copy(update={"traction_strips": strips})})
        self.p = film_places(one, pack(one, np.empty(0)), law)
        self.c = np.zeros(C.SIZE)
        self.c[C.VISCOSITY] = ETA
        self.w = np.zeros(W.ROWS)

    def numbers(self, race):
        return self.p[P.RACES + race * P.RACE_SIZE :][: P.RACE_SIZE]

    def row(self, race, place):
        return self.w[W.RACE + race * R.SIZE + place :][:STRIDE]

    def press(self, race, load, ut=0.0, um=0.0, an=0.0, rest=0.0, entrain=8.0):
        """Fill the rows for elastic loads (N), sliding (m/s), spin (rad/s) and entrainment (m/s)."""
        n = self.numbers(race)
        approach = (np.asarray(load) / n[P.RACE_STIFFNESS]) ** (2 / 3)
        self.row(race, R.LOAD)[:] = load
        self.row(race, R.HALF)[:] = n[P.RACE_HALF_LENGTH] * np.sqrt(approach)
        self.row(race, R.UT)[:] = ut
        self.row(race, R.UM)[:] = um
        self.row(race, R.AN)[:] = an
        self.row(race, R.AT)[:] = 0.1 * rest
        self.row(race, R.AM)[:] = rest
        self.row(race, R.ENTRAIN)[:] = entrain
        return self

    def run(self, race):
        lubricated_traction(self.p, self.c, STRIDE, race, self.w)
        return np.array([self.row(race, k) for k in SUMS])

    def film(self, race, lane):
        u, load = self.row(race, R.ENTRAIN)[lane], self.row(race, R.LOAD)[lane]
        speed = ETA * mp.sqrt(mp.mpf(u) ** 2 + mp.mpf("1e-8"))
        factor = mp.mpf(self.numbers(race)[P.RACE_CENTRAL_FILM])
        return mp.mpf("1e-9") + factor * speed ** mp.mpf("0.67") * (load + mp.mpf("1e-3")) ** mp.mpf("-0.067")

    def pressures(self, race, lane):
        """Half axes (m) and peak pressure (Pa)."""
        n = self.numbers(race)
        root = self.row(race, R.HALF)[lane] / n[P.RACE_HALF_LENGTH]
        return (
            n[P.RACE_HALF_LENGTH] * root,
            n[P.RACE_HALF_WIDTH] * root,
            mp.mpf(n[P.RACE_PRESSURE]) * root,
        )

    def sliding(self, race, lane, offset):
        sag = offset**2 / (2 * self.numbers(race)[P.RACE_PROFILE_RADIUS])
        ut, um, an, a_t, am = (
            mp.mpf(self.row(race, k)[lane])
            for k in (
                R.UT,
                R.UM,
                R.AN,
                R.AT,
                R.AM,
            )
        )
        return ut - offset * an - sag * am, um + sag * a_t, sag

    def slow(self, race, lane, law):
        """The five sums of one lane, strip by strip, in 40 digits."""
        mp.mp.dps = 40
        a, b, peak = self.pressures(race, lane)
        load, mu = mp.mpf(self.row(race, R.LOAD)[lane]), mp.mpf(self.p[P.MU])
        count, first = int(self.p[P.STRIPS]), int(self.p[P.AT_STRIPS])
        film = self.film(race, lane)
        total = [mp.mpf(0)] * 5
        for node, share in zip(self.p[first:][:count], self.p[first + count :][:count], strict=True):
            node, share = mp.mpf(node), mp.mpf(share)
            mean = mp.pi / 4 * peak * mp.sqrt(1 - node**2)
            area = share * mp.mpf(8) / 3 * a * b / mp.sqrt(1 - node**2)
            ut, um, sag = self.sliding(race, lane, node * a)
            spin = mp.mpf(self.row(race, R.AN)[lane])
            # half the strip's width, and the mean square of the place across it weighted with the pressure
            half = a * share / (mp.mpf(3) / 2 * (1 - node**2))
            across = b**2 / 4 * (1 - node**2)
            spread = half**2 + across if law == "eyring" else 0
            floor = mp.mpf(self.p[P.TRACTION_FLOOR]) if law == "eyring" else 0
            speed = mp.sqrt(ut**2 + um**2 + spread * spin**2 + floor**2)
            if speed == 0:
                continue
            if law == "eyring":
                eta, stress = roelands(mean, self.p[P.PRESSURE_VISCOSITY]), mp.mpf(5e6)
                shear = area * stress * mp.asinh(eta * speed / film / stress)
                pull = shear / mp.sqrt(1 + (shear / (mu * share * load)) ** 2)
            elif law == "regularised":
                entrain = mp.sqrt(mp.mpf(self.row(race, R.ENTRAIN)[lane]) ** 2 + mp.mpf("1e-8"))
                scale = self.p[P.SLIDE_TO_ROLL] * entrain + mp.mpf(self.p[P.TRACTION_FLOOR])
                pull = mu * share * load * speed / mp.sqrt(speed**2 + scale**2)
            else:
                pull = area * ETA * speed / film
            if self.p[P.THERMAL_TRACTION]:
                slides = mp.sqrt(ut**2 + um**2)
                flux = pull / speed * slides**2 / area
                pull *= self.left(race, lane, float(flux), float(b * mp.sqrt(1 - node**2)), float(film))
            ft, fm = -pull * ut / speed, -pull * um / speed
            turned = half**2 / 3 * (1 - (ut / speed) ** 2)
            own = pull / speed * (turned + across) * spin if law == "eyring" else 0
            parts = (ft, fm, -node * a * ft - own, sag * fm, -sag * ft)
            total = [t + x for t, x in zip(total, parts, strict=True)]
        return [float(t) for t in total]

    def heat(self, thinning=0.0):
        """Let friction heat the oil, which a kelvin thins by this share."""
        self.p[P.THERMAL_TRACTION] = 1.0
        self.p[P.OIL_CONDUCTIVITY] = CONDUCTIVITY
        self.c[C.THINNING] = thinning
        for race in range(2):
            self.numbers(race)[P.RACE_EFFUSIVITY] = 2.0 * EFFUSIVITY
        return self

    def left(self, race, lane, flux, half_width, film):
        """Share left under its own heat: flash of both surfaces and mean of the film, root by Brent."""
        entrain = np.hypot(self.row(race, R.ENTRAIN)[lane], 1e-4)
        flash = 4.0 / 3.0 * np.sqrt(2.0 / np.pi) * np.sqrt(half_width / entrain) / (2.0 * EFFUSIVITY)
        return mp.mpf(slid_share(flux, flash + film / (12.0 * CONDUCTIVITY), self.c[C.THINNING]))


def roelands(pressure, alpha):
    index = alpha * mp.mpf("1.96e8") / (mp.log(ETA) + mp.mpf("9.67"))
    return ETA * mp.exp((mp.log(ETA) + mp.mpf("9.67")) * ((1 + pressure / mp.mpf("1.96e8")) ** index - 1))


@pytest.fixture
def contact(scene):
    return lambda law, strips=5: Contact(scene, law, strips)


@pytest.mark.parametrize("law", ["eyring", "paper", "regularised"])
@pytest.mark.parametrize("race", [0, 1])
@pytest.mark.parametrize("thinning", [None, 0.03])
def test_against_every_strip_in_forty_digits(contact, law, race, thinning):
    rng = np.random.default_rng(race)
    one = contact(law).press(
        race,
        10.0 ** rng.uniform(-2, 3, STRIDE),
        ut=rng.normal(size=STRIDE) * 10.0 ** rng.uniform(-9, 1, STRIDE),
        um=rng.normal(size=STRIDE) * 10.0 ** rng.uniform(-9, 0, STRIDE),
        an=rng.normal(size=STRIDE) * 2000,
        rest=rng.normal(size=STRIDE) * 5000,
        entrain=rng.uniform(-20, 20, STRIDE),
    )
    if thinning is not None:
        one.heat(thinning)
    found = one.run(race)
    for lane in range(STRIDE):
        wanted = np.array(one.slow(race, lane, law))
        # strips may cancel: each sum against the sum of its strips' sizes, which the load bounds or is of
        scale = np.abs(found[:2, lane]).max() * np.array([1, 1, 1e-4, 1e-6, 1e-6])
        np.testing.assert_allclose(found[:, lane], wanted, rtol=1e-10, atol=1e-10 * scale.max())


def test_oil_that_keeps_its_viscosity_keeps_the_plain_law(contact):
    """The strips of `lubricated_traction` are those of `traction`, to rounding."""
    one = contact("regularised").press(
        0, 60.0, ut=np.linspace(-1.0, 1.0, STRIDE), um=0.02, an=800.0, rest=900.0
    )
    entrain = one.row(0, R.ENTRAIN)
    one.row(0, R.SCALE)[:] = one.p[P.SLIDE_TO_ROLL] * np.hypot(entrain, 1e-4) + one.p[P.TRACTION_FLOOR]
    traction(one.p, STRIDE, 0, one.w)
    plain = np.array([one.row(0, k) for k in SUMS]).copy()
    np.testing.assert_allclose(one.heat().run(0), plain, rtol=1e-12, atol=1e-18)


def test_warming_is_the_flash_of_surfaces_and_the_mean_of_the_film():
    flux, b, u, film = 1e7, 70e-6, 40.0, 0.3e-6
    surfaces = flash(flux, b, u, 2.0 * EFFUSIVITY, 1000)
    # the film carries the flux as its shear: eta (v/h)^2 h = q
    between = film_heat(flux * film / 25.0, 5.0, film, CONDUCTIVITY)
    found = flux * warming(b, u, 2.0 * EFFUSIVITY, film, CONDUCTIVITY)
    assert found == pytest.approx(surfaces + between, rel=1e-3)  # differences of the half-space


@pytest.mark.parametrize("x", [0.0, 1e-9, 0.1, 1.0, 7.0, 1e3, 1e12])
def test_share_that_is_left_under_its_own_heat(x):
    assert heated_share(x) == pytest.approx(slid_share(1.0, 1.0, x), rel=1e-12)


@pytest.mark.parametrize(
    ("slide", "spin", "gate"),
    [
        (1e-4, 0.0, 0.35),
        (1e-2, 0.0, 0.03),
        (1.0, 0.0, 0.03),
        (1.0, 1500.0, 0.03),
        (1e-2, 400.0, 0.15),
        (1e-3, 400.0, 0.15),
    ],
)
def test_strips_against_the_whole_ellipse(contact, slide, spin, gate):
    """Local pressure, viscosity and bound over the ellipse instead of five strips at their mean pressure.

    Viscosity grows so fast with pressure that a creeping contact pulls by the ridge of its pressure, which
    a mean underrates (a sixth at 1 um/s, 70 % at 0.1 mm/s); once Eyring's law saturates, stress hardly
    depends on it. With spin, five strips pull a tenth too hard while sliding is small against it.
    """
    one = contact("eyring").press(0, 60.0, ut=slide, um=0.0, an=spin)
    one.p[P.TRACTION_FLOOR] = 0.0
    found, _, moment, *_ = one.run(0)[:, 0]
    a, b, peak = (float(x) for x in one.pressures(0, 0))
    film, mu = float(one.film(0, 0)), one.p[P.MU]
    x, y = np.meshgrid((np.arange(400) + 0.5) / 200 - 1, (np.arange(400) + 0.5) / 200 - 1)
    x, y = x[x**2 + y**2 < 1], y[x**2 + y**2 < 1]
    pressure = peak * np.sqrt(1 - x**2 - y**2)
    ut, um = slide - spin * a * x, spin * b * y
    speed = np.hypot(ut, um)
    log = np.log(ETA) + 9.67
    index = one.p[P.PRESSURE_VISCOSITY] * 1.96e8 / log
    eta = ETA * np.exp(log * ((1 + pressure / 1.96e8) ** index - 1))
    tau = 5e6 * np.arcsinh(eta * speed / film / 5e6)
    tau /= np.sqrt(1 + (tau / (mu * pressure)) ** 2)
    whole = -(tau * ut / speed).sum() * a * b / 200**2
    turning = (tau * (ut * a * x - um * b * y) / speed).sum() * a * b / 200**2
    assert abs(found / whole - 1) < gate
    if spin > 0.0:
        assert abs(moment / turning - 1) < 0.2


def test_creeping_is_newtonian(contact):
    one = contact("eyring").press(0, 60.0, ut=np.array([1e-12, 1e-9] * (STRIDE // 2)))
    one.p[P.TRACTION_FLOOR] = 0.0
    force = one.run(0)[0]
    assert force[1] / force[0] == pytest.approx(1e3, rel=1e-6)
    a, b, peak = one.pressures(0, 0)
    first = int(one.p[P.AT_STRIPS])
    drag = sum(
        mp.mpf(8) / 3 * a * b * share / mp.sqrt(1 - mp.mpf(node) ** 2)
        * roelands(mp.pi / 4 * peak * mp.sqrt(1 - mp.mpf(node) ** 2), one.p[P.PRESSURE_VISCOSITY])
        for node, share in zip(one.p[first:][:5], one.p[first + 5 :][:5], strict=True)
    )  # fmt: skip
    assert -force[0] == pytest.approx(float(drag / one.film(0, 0) * 1e-12), rel=1e-9)


def test_gross_sliding_is_bounded(contact):
    loads = np.geomspace(1e-3, 1e4, STRIDE)
    one = contact("eyring").press(1, loads, ut=50.0, entrain=1e-3)
    one.p[P.MU] = 0.005  # the law grows with the logarithm of the sliding: a low bound is met sooner
    force = one.run(1)[0]
    assert (np.abs(force) < one.p[P.MU] * loads).all()
    pressed = loads > 10.0  # a light load's oil is too thin to reach the bound
    assert (np.abs(force[pressed]) > 0.97 * one.p[P.MU] * loads[pressed]).all()


@pytest.mark.parametrize("law", ["eyring", "paper"])
@pytest.mark.parametrize("race", [0, 1])
def test_traction_opposes_sliding_and_dissipates(contact, law, race):
    rng = np.random.default_rng(3)
    motion = {
        "ut": rng.normal(size=STRIDE),
        "um": rng.normal(size=STRIDE),
        "an": 2000 * rng.normal(size=STRIDE),
    }
    motion["rest"] = 5000 * rng.normal(size=STRIDE)
    one = contact(law).press(race, rng.uniform(0, 300, STRIDE), **motion)
    ft, fm, mn, mt, mm = one.run(race)
    lost = -(ft * motion["ut"] + fm * motion["um"] + mn * motion["an"])
    lost -= 0.1 * mt * motion["rest"] + mm * motion["rest"]
    assert (lost >= 0.0).all()
    one.press(race, 50.0, ut=motion["ut"], um=motion["um"])
    ft, fm, *_ = one.run(race)
    assert (ft * motion["ut"] < 0.0).all()
    np.testing.assert_allclose(ft * motion["um"], fm * motion["ut"], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("law", ["eyring", "paper"])
def test_extremes_stay_finite(contact, law):
    one = contact(law)
    for load in (0.0, 1e-12, 1e5):
        for slide in (0.0, 1e-30, 1e3):
            for entrain in (0.0, 100.0):
                for eta in (1e-6, 0.03, 1e4):
                    one.c[C.VISCOSITY] = eta
                    found = one.press(0, load, ut=slide, an=slide, entrain=entrain).run(0)
                    assert np.isfinite(found).all()
                    assert load > 0.0 or not found.any()


def test_the_papers_law_hardly_pulls(contact):
    """7003C, 20,000 r/min, ambient viscosity: sliding of 5 % of the rolling speed gives T/Q near 3e-5.

    The paper leaves V open; the figure is an order of magnitude (docs/theory).
    """
    speed = 20000 * RPM * 11.5e-3 / 2  # ring surface at the pitch circle, halved by the rolling ball
    one = contact("paper").press(0, 46.0, ut=0.05 * speed, entrain=speed)
    ratio = abs(one.run(0)[0, 0]) / 46.0
    assert 1e-5 < ratio < 1e-4
