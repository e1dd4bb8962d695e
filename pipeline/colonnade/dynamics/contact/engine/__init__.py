"""
The motion of one body on a table, step by step: kernels, each module one part of a step.

Each step drifts half a step without contact, takes the contact's impulse at that middle, and drifts the other half:

    drift   ẍ = g − a(t); free rotation; η̈ + 2 ζ ω η̇ + ω² η = 0, solved exactly
    kick    m Δv = h ΣF, ΔL = h Σ r × F, Δη̇ = h ΣΦᵀF, with F at the mean of the velocities before and after

Everything is relative to the table; gravity and the table's acceleration a act alike. A step calls, in this order:
`flight` (drift), `points` and `rings` (what may touch), `kick` with `force` (the law of contact), `flight` again, and
`watch` (where an arc of rocking ends); `sample` fills the rows of the result, and `run` walks over the samples.
Flight is of second order in the step, an impact of about first: of the paper's prism one impact later, a step of 10 µs
costs 2e-5 to 1e-4 of α.
"""
