"""Sound in the engine: filters from motion samples to pressures, and level meters.

============  ============================================================================
``places``    rates, and places in the sound blocks ``ps`` (parameters), ``ss`` (state), ``ws`` (work)
``radiate``   `radiate.push`: one motion sample in, filters and meters moved on
``meter``     `meter.levels`: what each microphone reads now
============  ============================================================================
"""
