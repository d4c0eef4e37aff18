"""Constants of a contact against a printed example."""

import pytest

from fmu_bearing.formulas.hertz import effective_modulus, point_contact


def test_contact_of_a_printed_ball_bearing():
    """Ball of 4.9 mm radius in a groove of 5 mm, race of 25 mm: 2193.6 MPa, 2.101 x 0.156 mm, 12 um.

    The inner race of amesweb.info's example (Contact stresses in a steel ball bearing), after Boresi and
    Schmidt, Advanced mechanics of materials: 12 balls, 3600 N, 5/12 of it on the top ball, steel of 210 GPa
    and 0.29.
    """
    ball, groove, race, load = 4.9e-3, 5e-3, 25e-3, 1500.0
    across, along = 1.0 / (1.0 / ball - 1.0 / groove), 1.0 / (1.0 / ball + 1.0 / race)
    contact = point_contact(along, across, effective_modulus(210e9, 0.29, 210e9, 0.29))
    approach = (load / contact.stiffness) ** (2.0 / 3.0)
    # the last digits printed
    assert 1e3 * approach == pytest.approx(0.012, abs=5e-4)
    assert 1e3 * contact.half_width * approach**0.5 == pytest.approx(0.156, abs=5e-4)
    # the printed pressure is 0.4 % off what the printed axes give, 1.5 load over the ellipse
    assert 1e3 * contact.half_length * approach**0.5 == pytest.approx(2.101, rel=4e-3)
    assert 1e-6 * contact.pressure * approach**0.5 == pytest.approx(2193.6, rel=4e-3)
