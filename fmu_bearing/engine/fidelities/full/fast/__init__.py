"""Method fast: one evaluation per step, guarded.

============  =========================================================================
``newmark``   one step, for a bearing that has settled
``blocks``    blocks of such steps, kept only if the last one proves them right
============  =========================================================================
"""
