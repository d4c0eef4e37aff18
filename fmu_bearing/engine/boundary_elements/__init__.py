"""Boundary elements: kernels that integrate over line elements of bodies of revolution.

==================  ==========================================================================
``ring_potential``  harmonics of 1/R between two rings, in closed form
``closed_part``     their integrals over elements: what holds for all frequencies
``remainder``       the smooth rest of the kernel at one frequency, four azimuths at a time
==================  ==========================================================================

They prepare sound; no step calls them. `acoustics.radiation.bem.integrals` calls them and explains how the
kernel is split.
"""
