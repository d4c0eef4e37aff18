"""Sound in the engine: filters from motion samples to pressures, and level meters.

=============  ===========================================================================
``places``     rates, and places in the sound blocks ``ps`` (parameters), ``ss`` (state), ``ws`` (work)
``radiate``    `radiate.push`: one motion sample in, filters and meters moved on
``channels``   what each rung takes from a motion sample
``convolve``   filters: direct form, and blocks in the frequency domain
``transform``  Fourier transforms of many signals at once
``meter``      `meter.levels`: what each microphone reads now
``thirds``     third octaves
=============  ===========================================================================
"""
