"""The native build: the engine's kernels compiled ahead of time behind a C shim, no Python at run time.

==============  ====================================================================================
``platforms``   targets of FMI 2.0 and what compiles for them
``entries``     the three entries of the engine with the signature of C, as LLVM code
``optimise``    that code optimised for one instruction set, as an object file
``compile``     both steps for all instruction sets of a platform, kept by a hash of the engine
``shim``        FMI 2.0 co-simulation in C99, the same for every scene and platform
``link``        objects and shim -> one shared library per platform
``model_file``  a model as the bytes of ``resources/model.bin``
==============  ====================================================================================

The shim, one file per task: ``fmi2_life``, ``fmi2_values``, ``fmi2_step``, ``fmi2_rates``, ``fmi2_status``
and ``fmi2_state`` hold the functions of FMI and nothing else; ``calls`` says which is allowed in which
phase; ``instance`` owns the arrays and runs the kernels that ``kernels`` chose for the processor; ``model``
reads and checks ``model.bin``, found by ``path``; ``state`` lays an instance out as one block; ``log``,
``text`` and ``digest`` serve them all.
"""
