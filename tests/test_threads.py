"""Small matrices are solved on one thread."""

import numpy as np

# SciPy has a library of its own. Were it first loaded by `one_thread`, it would be missing before the call.
import scipy.linalg  # noqa: F401
import threadpoolctl

from fmu_bearing.threads import one_thread


def threads():
    np.linalg.inv(np.eye(2))  # the library is loaded
    return [pool["num_threads"] for pool in threadpoolctl.threadpool_info() if pool["user_api"] == "blas"]


def test_a_function_runs_on_one_thread_and_leaves_them_as_they_were():
    with threadpoolctl.threadpool_limits(2):
        before = threads()
        assert before
        assert 2 in before
        assert set(one_thread(threads)()) == {1}
        assert threads() == before
