"""Values to which the papers' pages fit free numbers, one number for each."""

#: All other values are checked.
FITTED = {
    "multi-source": {"P3, 10,000 r/min", "P1, line f_r, 28,000 r/min", "P3, 30,000 r/min"},
    "sound-field": {"18,000 r/min, 210 deg"},
    "impact-noise": {"10,000 r/min", "20,000 r/min"},
    "printed": set(),
}
