"""The operating point: the steady state of the full equations, from which runs start.

The quasi-static state (``statics``) holds the balls' gyroscopic moments by an assumed share of friction at
each race, and its balls know nothing of the cage. Here friction, drag, films and pockets balance by
themselves. Imperfections count as none.

=============  ==========================================================================
``even``       all balls equal, the cage centred: eleven unknowns
``pattern``    unequal balls: a pattern through which they run, and the whirl of the cage
``equations``  what is out of balance in a pattern, and its derivatives
``newton``     Newton's method for a pattern
``growth``     whether the whirl of a cage grows about the pattern at rest
``carried``    where none is found: quasi-static balls, which roll or which the cage carries
``point``      the operating point of a bearing: which of them holds
``transfer``   from a quasi-static state to it
=============  ==========================================================================
"""
