"""table.py - the cases of the suite: what make.py makes files of. A case is one call of `case`; the order is that of the suite.

Numbers are decimals of at most 15 digits, so that a program that reads them has the model that is proven. Directions
are {DOF: coefficient}, DOFs count from 1. Slanted contacts have tangent 0.6 and normal 0.8, which need no angle.
"""
CASES = []


def case(group, name, title, tests, wrong, at, mass, damping, stiffness, loads, contacts, response=1, harmonics=200, sweep=None):
    CASES.append(dict(group=group, name=name, title=title, tests=tests, wrong=wrong, at=at, mass=mass, damping=damping, stiffness=stiffness,
                      loads=loads, contacts=contacts, response=response, harmonics=harmonics, sweep=sweep or [0.8 * min(at), 1.25 * max(at)]))


def cos(dof, amplitude, harmonic=1):
    return dict(dof=dof, amplitude=amplitude, harmonic=harmonic)


def one(group, name, title, tests, wrong, at, contacts, k=40, c=1, F=50, loads=None, **more):
    """One mass of 1."""
    case(group, name, title, tests, wrong, at, [[1]], [[c]], [[k]], loads or [cos(1, F)], contacts, **more)


def jenkins(kt, limit, tangent=None, mu=1):
    return dict(tangential_stiffness=kt, friction=mu, preload=limit, tangent=tangent or {1: 1})


def stop(kn, gap, normal=None):
    return dict(normal_stiffness=kn, gap=gap, normal=normal or {1: 1})


def foot(kt, kn, mu, gap, tangent=None, normal=None):
    return dict(tangential_stiffness=kt, normal_stiffness=kn, friction=mu, gap=gap, tangent=tangent or {1: 0.6}, normal=normal or {1: 0.8})


def chain(n, k=1.0, c=0.02, ground=0.2):
    """M, C, K of n masses of 1 in a row, each also held by a weak spring."""
    K = [[0.0] * n for _ in range(n)]
    for i in range(n):
        K[i][i] += ground
        if i:
            K[i][i] += k
            K[i - 1][i - 1] += k
            K[i][i - 1] -= k
            K[i - 1][i] -= k
    rounded = [[round(v, 12) for v in row] for row in K]
    return [[float(i == j) for j in range(n)] for i in range(n)], [[round(c * v, 12) for v in row] for row in K], rounded


# ---- linear limits --------------------------------------------------------------------------------------------------------------------
L = "linear limits"
one(L, "open", "A stop that is never reached", "The linear response: mass, damping, force.", "Factors: peak to peak, rms, cycles for rad.",
    [4, 6.3, 9], [stop(1000, -100)], harmonics=5)
one(L, "bonded", "A slider that never slips", "K + kt, and a mean that the slider's place decides (not asked).", "kt added twice, or not at all.",
    [9, 11, 14], [jenkins(100, 1000)], harmonics=5)
one(L, "pressed", "A preloaded stop that never opens", "K + kn; the preload does not act on the mass.", "The preload taken for a load: a mean.",
    [9, 11, 14], [stop(100, 5)], harmonics=5)
one(L, "static_load", "A static load and one that varies", "Harmonic 0 of the load.", "A mean that is halved, doubled or dropped.",
    [4, 6.3, 9], [stop(1000, -100)], loads=[cos(1, 50), cos(1, 30, 0)], harmonics=5)
one(L, "two_loads", "Loads of harmonic 1 and 3", "Loads of a higher harmonic; the amplitude is no harmonic's.", "amplitude = |harmonic 1|.",
    [2, 3, 5], [stop(1000, -100)], loads=[cos(1, 50), cos(1, 20, 3)], harmonics=5)
one(L, "light", "Damping of 1e-4 of critical at resonance", "An ill-conditioned linear equation; the sign of b1.", "Phase: b1 with the sign of exp(-i omega t).",
    [6.3, 6.3245, 6.33], [stop(1000, -100)], c=0.00126, F=0.01, harmonics=5)
case(L, "two_masses", "Two masses, damping that is not proportional", "Matrices, and the motion of another mass than the load's.",
     "Modal damping in the place of C; the wrong coordinate.", [0.6, 1.2, 1.9], [[1, 0], [0, 0.5]], [[0.1, 0], [0, 0]], [[2, -1], [-1, 1]],
     [cos(1, 1)], [stop(10, -100, {2: 1})], response=2, harmonics=5)
case(L, "turning", "Gyroscopic damping", "A matrix C that is not symmetric.", "C transposed: the phase of the second coordinate.", [0.7, 1.3, 2],
     [[1, 0], [0, 1]], [[0.1, 0.5], [-0.5, 0.1]], [[2, 0], [0, 3]], [cos(1, 1)], [stop(10, -100, {2: 1})], response=2, harmonics=5)

# ---- friction under a constant normal load --------------------------------------------------------------------------------------------
J = "friction, constant normal load"
one(J, "jenkins", "Jenkins element, half of the motion slides", "Hysteresis: the force after a reversal.", "The sign of friction; the slider kept over one period only.",
    [6, 8, 10], [jenkins(100, 20)], harmonics=100)
one(J, "jenkins_barely", "Just beyond the limit of slip", "Slip over a small part of the period.", "Too few samples see no slip.",
    [8, 9, 9.6], [jenkins(100, 60)])
one(J, "jenkins_sliding", "Slip nearly all the time", "The corners of the force, where harmonics decay slowly.", "Regularised friction.",
    [4, 6, 8], [jenkins(400, 10)])
one(J, "jenkins_mean", "Jenkins element and a static load", "Slip takes the mean to where the spring alone holds it.", "Harmonic 0 of friction dropped.",
    [5, 6.3, 8], [jenkins(60, 20)], loads=[cos(1, 50), cos(1, 15, 0)], harmonics=100)
one(J, "iwan", "Three elements side by side", "Elements that slip one after another.", "One slider's memory used for all.",
    [6, 8, 9.5], [jenkins(50, 5), jenkins(50, 15), jenkins(50, 40)])
one(J, "dry_only", "Friction is the only damping", "The amplitude at resonance, which friction alone limits.", "Equivalent damping; the limit mu N with the wrong N.",
    [7.4, 8.2, 9], [jenkins(60, 30)], c=0, F=25, harmonics=100)
case(J, "jenkins_chain", "Two masses, friction between them", "A relative motion u = x1 - x2.", "One side of the contact with the wrong sign.",
     [5.5, 7, 9], [[1, 0], [0, 1]], [[0.5, 0], [0, 0.5]], [[60, -20], [-20, 60]], [cos(1, 30)], [jenkins(50, 8, {1: 1, 2: -1})], response=2, harmonics=100)
case(J, "tip", "Friction far from the load", "A coordinate that the load does not touch.", "Response and load coordinate exchanged.",
     [0.55, 0.9, 1.4], *chain(4), [cos(4, 1)], [jenkins(2, 0.5, {1: 1})], response=4, harmonics=100)
case(J, "two_sliders", "Two sliders on a chain of three", "Sliders that change at different instants.", "Events of one contact looked for alone.",
     [0.5, 0.8, 1.2], *chain(3), [cos(2, 1)], [jenkins(3, 0.6), jenkins(3, 0.4, {3: 1, 2: -1})], response=3, harmonics=100)

# ---- stops and gaps -------------------------------------------------------------------------------------------------------------------
S = "stops and gaps"
one(S, "clearance", "A stop behind a clearance", "Contact for a part of the period; a mean that no load has.", "Harmonic 0 dropped.",
    [5, 7, 9], [stop(100, -1)])
one(S, "bilinear", "A stop without clearance", "A stiffness that jumps at 0: the response is proportional to the load.", "A mean that is missing.",
    [4, 7, 11], [stop(60, 0)])
one(S, "lifting", "A preloaded stop that opens", "N - N0 acts, and N >= 0.", "Preload not subtracted; contact that pulls.",
    [6, 9, 11], [stop(80, 0.3)])
one(S, "two_sided", "Stops on both sides", "Odd harmonics alone.", "Nothing, so that what fails here fails at the contact itself.",
    [6, 8, 10], [stop(100, -1), stop(100, -1, {1: -1})])
one(S, "unequal", "Stops at unequal distance", "Two gaps, even harmonics.", "The gap's sign.", [6, 8, 10], [stop(100, -1), stop(60, -0.4, {1: -1})])
one(S, "harder", "A stop ten times as stiff as the spring", "Short contact, many harmonics.", "Samples: 64 a period are off by percents.",
    [6, 8, 10], [stop(400, -1)])
one(S, "stiff", "A stop a hundred times as stiff", "Very short contact.", "Samples; few harmonics.", [6, 8], [stop(4000, -1)])
one(S, "grazing", "A stop that is nearly grazed", "Contact over a hundredth of the period.", "Fewer samples than it takes to see it.", [9.5, 9.55], [stop(200, -0.97)], c=2)
one(S, "third", "At a third of the resonance", "A superharmonic: the third harmonic is large.", "Too few harmonics.", [2.2, 2.5, 2.8], [stop(100, -0.5)], c=0.4)
one(S, "half", "At half of the resonance", "A superharmonic of a bilinear spring.", "Only odd harmonics kept.", [3, 3.4, 3.8], [stop(60, 0)], c=0.4)
one(S, "hanging", "A static load holds the stop shut", "Load and preload: which part is static.", "The static load left out.",
    [7, 9, 11], [stop(80, 0)], loads=[cos(1, 30), cos(1, 20, 0)])
case(S, "stop2", "Two masses and a stop", "A stop on a mass that no load acts on.", "The contact force on the wrong coordinate.",
     [4.5, 6.5, 9], [[1, 0], [0, 1]], [[0.6, 0], [0, 0.6]], [[60, -20], [-20, 60]], [cos(1, 40)], [stop(60, -0.3, {2: 1})], response=2)
case(S, "between", "A stop between two masses", "The gap closes by relative motion.", "A contact force on one side alone.",
     [5, 7, 9], [[1, 0], [0, 2]], [[0.6, 0], [0, 0.6]], [[60, 0], [0, 60]], [cos(1, 40)], [stop(80, -0.2, {1: 1, 2: -1})], response=1)
