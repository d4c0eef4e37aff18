"""From the state to outputs, losses and motion samples.

============  ==========================================================================
``contacts``  contacts of the balls, from a step's rows to the state, from there to ``z``
``defects``   balls over local defects: when they came, struck and passed
``losses``    sliding and losses by source, once per communication step
``motion``    motion samples for the sound filters, at a fixed rate
``outputs``   the outputs ``z``; everything follows from the state alone
============  ==========================================================================
"""
