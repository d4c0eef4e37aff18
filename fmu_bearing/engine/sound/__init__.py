"""Sound in the engine: filters from motion samples to pressures, or sums of lines, and level meters.

=============  ===========================================================================
``radiate``    `radiate.push`: one motion sample in, filters and meters moved on
``channels``   what each form of channels takes from a motion sample
``high_pass``  lower limit of the microphones
``convolve``   filters: direct form, and blocks in the frequency domain
``section``    one section of second order, lanes side by side
``transform``  Fourier transforms of many signals at once
``meter``      `meter.levels`: what each microphone reads now
``thirds``     third octaves
``accelerometer``  accelerometers: resonances, meters, outputs
``transfer``   lines: from channels to the pressure at every microphone
``beats``      lines: mean squares, and meters that follow them
=============  ===========================================================================

Places in the sound blocks: `layout.sound`, of lines also `layout.sound_lines`.
"""
