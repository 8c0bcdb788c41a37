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
    [6.5, 7, 7.5, 8, 8.5, 9, 10], [jenkins(60, 20)])
one(J, "jenkins_barely", "Just beyond the limit of slip", "Slip over a small part of the period.", "Too few samples see no slip.",
    [8, 9, 9.6], [jenkins(100, 60)])
one(J, "jenkins_sliding", "Slip nearly all the time", "The corners of the force, where harmonics decay slowly.", "Regularised friction.",
    [5, 6.5, 8], [jenkins(60, 4)])
one(J, "jenkins_mean", "Jenkins element and a static load", "Slip takes the mean to where the spring alone holds it.", "Harmonic 0 of friction dropped.",
    [5.5, 6.5, 8], [jenkins(50, 20)], loads=[cos(1, 50), cos(1, 15, 0)])
one(J, "iwan", "Three elements side by side", "Elements that slip one after another.", "One slider's memory used for all.",
    [6, 8, 9.5], [jenkins(50, 5), jenkins(50, 15), jenkins(50, 40)])
one(J, "dry_only", "Friction is the only damping", "The amplitude at resonance, which friction alone limits.", "Equivalent damping; the limit mu N with the wrong N.",
    [7.4, 8.2, 9], [jenkins(45, 30)], c=0, F=25)
case(J, "jenkins_chain", "Two masses, friction between them", "A relative motion u = x1 - x2.", "One side of the contact with the wrong sign.",
     [5.5, 7, 9], [[1, 0], [0, 1]], [[0.5, 0], [0, 0.5]], [[60, -20], [-20, 60]], [cos(1, 30)], [jenkins(50, 8, {1: 1, 2: -1})], response=2)
case(J, "tip", "Friction far from the load", "A coordinate that the load does not touch.", "Response and load coordinate exchanged.",
     [0.6, 0.95, 1.4], *chain(4), [cos(4, 1)], [jenkins(1, 0.5, {1: 1})], response=4)
case(J, "two_sliders", "Two sliders on a chain of three", "Sliders that change at different instants.", "Events of one contact looked for alone.",
     [0.7, 0.95, 1.3], *chain(3), [cos(2, 1)], [jenkins(1, 0.6), jenkins(1, 0.4, {3: 1, 2: -1})], response=3)

# ---- stops and gaps -------------------------------------------------------------------------------------------------------------------
S = "stops and gaps"
one(S, "clearance", "A stop behind a clearance", "Contact for a part of the period; a mean that no load has.", "Harmonic 0 dropped.",
    [5, 6, 7, 7.5, 8, 9], [stop(100, -1)])
one(S, "bilinear", "A stop without clearance", "A stiffness that jumps at 0: the response is proportional to the load.", "A mean that is missing.",
    [4, 7, 11], [stop(60, 0)])
one(S, "lifting", "A preloaded stop that opens", "N - N0 acts, and N >= 0.", "Preload not subtracted; contact that pulls.",
    [6, 7, 8, 9, 10, 11], [stop(80, 0.3)])
one(S, "two_sided", "Stops on both sides", "Odd harmonics alone.", "Nothing, so that what fails here fails at the contact itself.",
    [6, 8, 10], [stop(100, -1), stop(100, -1, {1: -1})])
one(S, "unequal", "Stops at unequal distance", "Two gaps, even harmonics.", "The gap's sign.", [6, 8, 10], [stop(100, -1), stop(60, -0.4, {1: -1})])
one(S, "harder", "A stop six times as stiff as the spring", "Short contact, many harmonics.", "Samples: 64 a period are off by percents.",
    [7, 8, 9], [stop(250, -1)])
one(S, "stiff", "A stop a hundred times as stiff as the spring", "A soft spring, and a stop that decides the motion.", "Samples; few harmonics; a lost mean.",
    [12, 13], [stop(200, 0)], k=2, c=8, loads=[cos(1, 60), cos(1, 30, 0)])
one(S, "grazing", "A stop that is nearly grazed", "Contact over a tenth of the period.", "Fewer samples than it takes to see it.", [8.6, 8.65, 8.7], [stop(100, -1.4)])
one(S, "third", "At a third of the resonance", "A superharmonic: the third harmonic is large.", "Too few harmonics.", [2.5, 2.65, 2.8], [stop(40, -0.5)], c=0.6)
one(S, "half", "At half of the resonance", "A superharmonic of a bilinear spring.", "Only odd harmonics kept.", [3, 3.4, 3.8], [stop(60, 0)], c=0.4)
one(S, "hanging", "A static load holds the stop shut", "Load and preload: which part is static.", "The static load left out.",
    [7, 9, 11], [stop(80, 0)], loads=[cos(1, 30), cos(1, 20, 0)])
case(S, "stop2", "Two masses and a stop", "A stop on a mass that no load acts on.", "The contact force on the wrong coordinate.",
     [4.5, 6.5, 9], [[1, 0], [0, 1]], [[0.6, 0], [0, 0.6]], [[60, -20], [-20, 60]], [cos(1, 40)], [stop(60, -0.3, {2: 1})], response=2)
case(S, "between", "A stop between two masses", "The gap closes by relative motion.", "A contact force on one side alone.",
     [5, 7, 9], [[1, 0], [0, 2]], [[0.6, 0], [0, 0.6]], [[60, 0], [0, 60]], [cos(1, 40)], [stop(80, -0.2, {1: 1, 2: -1})], response=1)

# ---- friction under a normal load that varies -----------------------------------------------------------------------------------------
O = "normal load that varies"
at = [5, 6.5, 8]
many = [5, 5.5, 6, 6.5, 7, 7.5, 8]
one(O, "foot", "A slanted contact behind a clearance", "Stick, slip and separation in one period.", "The slider after a separation: put to zero, or kept.",
    [5, 5.5, 6, 6.5, 7, 7.5], [foot(40, 60, 0.3, -0.6)])
one(O, "foot_pressed", "A slanted contact under preload", "A limit of friction that follows N(t).", "N constant: mu N0.", many, [foot(40, 60, 0.3, 0.8)])
one(O, "foot_zero", "A slanted contact without clearance", "Contact that begins at rest.", "The gap's sign; a slider that starts anywhere.", at, [foot(40, 60, 0.3, 0)])
one(O, "foot_slippery", "Little friction", "mu = 0.05.", "Friction left out.", at, [foot(40, 60, 0.05, 0.2)])
one(O, "foot_rough", "Much friction", "mu = 0.9: sticks as soon as it touches.", "kt and kn exchanged; slip by force of habit.", many, [foot(40, 60, 0.9, -0.3)])
one(O, "foot_flat", "A contact nearly along its surface", "Tangent 0.96, normal 0.28.", "The angle from the other axis.",
    at, [foot(40, 60, 0.4, 0.2, {1: 0.96}, {1: 0.28})])
one(O, "foot_steep", "A contact nearly across its surface", "Tangent 0.28, normal 0.96.", "Degrees and radians.",
    at, [foot(40, 60, 0.4, -0.2, {1: 0.28}, {1: 0.96})])
one(O, "foot_static", "A slanted contact under a static load", "Static and dynamic motion coupled by friction.", "Harmonic 0 of friction dropped.",
    many, [foot(40, 60, 0.3, -0.2)], loads=[cos(1, 50), cos(1, 20, 0)])
one(O, "foot_pull", "A static load that opens the contact", "The same load with the other sign.", "The sign of static loads.",
    many, [foot(40, 60, 0.3, 0.6)], loads=[cos(1, 50), cos(1, -15, 0)])
one(O, "foot_heavy", "kt larger than kn", "Stick stiffer than the normal spring.", "kt and kn exchanged.", at, [foot(80, 30, 0.5, 0.2)])
one(O, "foot_light", "Light damping", "Damping 0.2 % of critical: friction does the rest.", "Other damping; transients that have not settled.",
    [5, 8, 9.5], [foot(40, 60, 0.3, 0.3)], c=0.025, F=20)
one(O, "two_feet", "Two slanted contacts, left and right", "Contacts that touch in turn.", "One angle for both.",
    at, [foot(30, 50, 0.3, -0.4), foot(30, 50, 0.3, -0.4, {1: 0.6}, {1: -0.8})])
one(O, "three_feet", "Three contacts with other gaps", "Contacts that close one after another.", "One contact's state used for all.",
    at, [foot(20, 40, 0.3, -0.2), foot(20, 40, 0.3, -0.5), foot(20, 40, 0.3, -0.8)])
one(O, "foot_and_slider", "A slanted contact beside a Jenkins element", "Varying and constant normal load together.", "N of one used for the other.",
    at, [foot(40, 60, 0.3, -0.3), jenkins(20, 8)])
one(O, "foot_third", "A load of harmonic 3 beside harmonic 1", "Several reversals of slip in a period.", "Load harmonics above 1 dropped.",
    [3, 4, 5], [foot(40, 60, 0.3, 0.2)], loads=[cos(1, 40), cos(1, 25, 3)])
M2, C2, K2 = [[1, 0], [0, 1]], [[0.6, 0], [0, 0.6]], [[60, -20], [-20, 60]]
case(O, "tangent_normal", "Tangent and normal are two coordinates", "Friction on one, normal load from the other.", "N constant; tangent and normal exchanged.",
     [5.5, 6, 6.5, 7, 8, 9], M2, C2, K2, [cos(1, 30), cos(2, 10)], [foot(40, 40, 0.4, 0.3, {1: 1}, {2: 1})])
case(O, "normal_side", "The same, by the second coordinate", "The normal motion, which friction alone feeds.", "Response of another coordinate.",
     [5.5, 7, 9], M2, C2, K2, [cos(1, 30), cos(2, 10)], [foot(40, 40, 0.4, 0.3, {1: 1}, {2: 1})], response=2)
case(O, "weight", "A static load presses the contact", "Preload by a load instead of a gap.", "Static load left out: it opens.",
     [5.5, 7, 9], M2, C2, K2, [cos(1, 30), cos(2, 15, 0), cos(2, 5)], [foot(40, 40, 0.4, 0, {1: 1}, {2: 1})])
case(O, "relative", "Two masses, one contact between them", "Tangent and normal are relative motions.", "One side with the wrong sign.",
     [5.5, 7, 9], M2, C2, [[60, 0], [0, 80]], [cos(1, 40)], [foot(40, 40, 0.3, 0.2, {1: 0.6, 2: -0.6}, {1: 0.8, 2: -0.8})])
case(O, "wedge", "A mass between two walls under a static load", "Two contacts, slanted the one way and the other.", "Normals of the wrong side.",
     [6, 8, 10], M2, C2, [[40, 0], [0, 40]], [cos(1, 40), cos(2, 20, 0)],
     [foot(40, 60, 0.3, 0, {1: 0.8, 2: 0.6}, {1: -0.6, 2: 0.8}), foot(40, 60, 0.3, 0, {1: 0.8, 2: -0.6}, {1: 0.6, 2: 0.8})])

# ---- several solutions ----------------------------------------------------------------------------------------------------------------
B = "several solutions"
one(B, "fold", "Three solutions beside a stop", "Two stable ones and an unstable one.", "A solver that follows one branch misses two.", [7.3, 7.6, 7.9], [stop(120, -1.5)], c=0.2, F=15)
one(B, "fold_edge", "Just inside the fold", "Two of three solutions are near each other.", "Arc length that steps over the fold.", [7.1, 8.08], [stop(120, -1.5)], c=0.2, F=15)
one(B, "fold_two_sided", "Stops on both sides, light damping", "A wide fold.", "A jump at the wrong frequency.", [9.5, 11, 12], [stop(120, -1), stop(120, -1, {1: -1})], c=0.3)
one(B, "softening", "A preloaded stop that opens and bends the curve to the left", "A softening resonance.", "The upper branch lost.", [8.5, 8.8, 9.05], [stop(80, 1.2)], c=0.4)
one(B, "foot_fold", "Friction and separation with a fold", "Unstable solutions with slip.", "Stability by the sign of the step.", [7.2, 7.4, 7.6], [foot(20, 120, 0.1, -1.2)], c=0.15, F=15)
one(B, "foot_jump", "Friction and separation at the upper end of the fold", "Where the curve jumps down.", "A branch lost.", [7.7, 7.8], [foot(20, 120, 0.1, -1.2)], c=0.15, F=15)
one(B, "unstable", "Unstable solutions of a bilinear spring", "Near twice the resonance the period doubles.", "Time integration, which cannot stay there.", [14.6, 15, 15.5], [stop(150, 0)], c=0.2)
case(B, "fold_two", "Two masses and a stop with a fold", "Three solutions of a structure.", "One of them missing.",
     [9.4, 9.45, 9.5], M2, [[0.3, 0], [0, 0.3]], K2, [cos(1, 20)], [stop(80, -1, {2: 1})], response=2)

# ---- larger -----------------------------------------------------------------------------------------------------------------------------
N = "larger structures"
case(N, "chain4", "Four masses, slider and stop", "Contacts of two kinds.", "Contact forces on the wrong coordinate.", [0.7, 1.1, 1.5], *chain(4), [cos(2, 1)],
     [jenkins(0.5, 0.3, {1: 1}), stop(1, -0.5, {4: 1})], response=2)
case(N, "chain5", "Five masses, slanted contact at the end", "Varying normal load on a structure.", "N constant.", [0.6, 1.0], *chain(5), [cos(3, 1)],
     [foot(0.5, 0.8, 0.3, 0.2, {5: 0.6}, {5: 0.8})], response=5)
case(N, "chain6", "Six masses, three sliders between them", "Several relative motions.", "One side with the wrong sign.", [0.7, 1.1], *chain(6), [cos(1, 1)],
     [jenkins(0.5, 0.25, {i: 1, i + 1: -1}) for i in (1, 3, 5)], response=3)
case(N, "chain8", "Eight masses, two stops", "Stops far from the load.", "Modes left out.", [0.6, 1.1], *chain(8), [cos(4, 1)],
     [stop(1, -0.3, {1: 1}), stop(1, -0.3, {8: 1})], response=8)
case(N, "chain10", "Ten masses under a static load", "A mean that all coordinates have.", "Harmonic 0 dropped.", [0.7, 1.3], *chain(10), [cos(5, 1), cos(5, 0.4, 0)],
     [jenkins(0.5, 0.3, {5: 1}), stop(0.8, 0, {10: 1})], response=5)
case(N, "chain12", "Twelve masses, four contacts", "Many transitions.", "Events of one contact looked for alone.", [0.7, 1.1], *chain(12), [cos(6, 1)],
     [jenkins(0.4, 0.2, {3: 1}), jenkins(0.4, 0.3, {6: 1}), stop(0.6, -0.2, {9: 1}), stop(0.6, -0.2, {12: 1})], response=6)
case(N, "chain16", "Sixteen masses, slider and stop", "n = 16.", "Reduction that leaves contact modes out.", [0.6, 1.18], *chain(16), [cos(8, 1)],
     [jenkins(0.5, 0.3, {8: 1}), stop(0.8, -0.3, {12: 1})], response=8)
case(N, "chain16_feet", "Sixteen masses, a slanted contact", "Varying normal load, n = 16.", "N constant.", [0.9], *chain(16), [cos(8, 1)],
     [foot(0.5, 0.8, 0.3, 0.1, {10: 0.6}, {10: 0.8})], response=10)

# ---- smooth laws: references of stated error --------------------------------------------------------------------------------------------
P = "smooth laws"


def spring(direction=None, **coefficients):
    """Force: the sum of c_k d^k, given as c3=..."""
    return dict(law="polynomial", direction=direction or {1: 1}, coefficients={int(k[1:]): v for k, v in coefficients.items()})


def tanh(limit, epsilon, tangent=None):
    return dict(law="tanh", friction=1, preload=limit, epsilon=epsilon, tangent=tangent or {1: 1})


one(P, "duffing", "Cubic spring, hardening", "Three solutions, one unstable.", "The factor 3/4; a branch lost.", [6, 8, 9.5], [spring(c3=2)], c=0.4, F=30, harmonics=40)
one(P, "duffing_soft", "Cubic spring, softening", "A curve that leans left.", "The sign of the cubic term.", [4.5, 5.4, 7], [spring(c3=-1)], c=0.6, F=10, harmonics=40)
one(P, "duffing_third", "Cubic spring at a third of the resonance", "A superharmonic.", "Too few harmonics.", [2, 2.3, 2.6], [spring(c3=4)], c=0.4, F=60, harmonics=60)
one(P, "quadratic", "Quadratic and cubic spring", "A mean that no load has.", "Harmonic 0 dropped.", [5, 6, 8], [spring(c2=6, c3=3)], c=0.6, F=15, harmonics=40)
one(P, "quintic", "Quintic spring", "A fifth power: samples >= 6 H + 1.", "Aliasing of a polynomial.", [6, 8, 9], [spring(c5=1)], c=0.6, F=20, harmonics=60)
one(P, "duffing_static", "Cubic spring under a static load", "Static and dynamic motion coupled.", "Static load dropped.", [5, 7, 9], [spring(c3=3)], c=0.6, F=20,
    loads=[cos(1, 20), cos(1, 20, 0)], harmonics=40)
one(P, "tanh", "Regularised friction", "T = mu N tanh(u'/epsilon).", "Taken for Coulomb's law.", [5, 8, 9], [tanh(10, 2)])
case(P, "duffing2", "Two masses, a cubic spring between them", "A relative motion to the third power.", "One side with the wrong sign.", [5.5, 7, 9], M2, C2, K2,
     [cos(1, 20)], [spring({1: 1, 2: -1}, c3=10)], response=2, harmonics=40)
