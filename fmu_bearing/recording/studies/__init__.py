"""What several runs say together.

===================  ==========================================================================
``level_estimator``  levels of many short runs through the same paths
``spread``           `spread`: range of levels over seeds and the assumed surfaces
``comparison_data``  what a comparison reads of a run
``pairs``            rows of the tables of a comparison
``finding``          whether the difference of two levels is a finding
``compare``          `compare`: two scenes, recordings or runs side by side
===================  ==========================================================================
"""
