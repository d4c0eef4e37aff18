"""Values to which the specification of the papers' pages fits free numbers."""

#: What the specification fixes; all other values are checked.
FITTED = {
    "multi-source": {"P3, 10,000 r/min", "P3, 30,000 r/min", "P1, line f_r, 28,000 r/min"},
    "sound-field": {"18,000 r/min, 210 deg", "3,000 r/min, 180 deg"},
    "impact-noise": {"10,000 r/min"},
    "printed": set(),
}
