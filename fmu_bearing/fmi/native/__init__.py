"""The native build: the compiled kernels behind a C shim, no Python at run time.

==============  ====================================================================================
``shim``        FMI 2.0 co-simulation in C99, the same for every scene and platform
``link``        objects and shim -> one shared library per platform
``prebuilt``    what a wheel brings along for one platform
``model_file``  a model as the bytes of ``resources/model.bin``
==============  ====================================================================================

The shim, one file per task: ``fmi2_life``, ``fmi2_values``, ``fmi2_step``, ``fmi2_rates``, ``fmi2_status``
and ``fmi2_state`` hold the functions of FMI and nothing else; ``calls`` says which is allowed in which
phase; ``instance`` owns the arrays and runs the kernels that ``kernels`` chose for the processor; ``model``
reads and checks ``model.bin``, found by ``path``; ``state`` lays an instance out as one block; ``log``,
``text`` and ``digest`` serve them all.
"""
