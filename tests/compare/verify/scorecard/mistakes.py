"""The mistakes of the scorecard: what is wrong with the curve, and what an expert would call it, written down before
any answer of `hbmcheck verify` was looked at.

    right    the causes (compare/verify/equations/causes.h) that may be named, one set for each answer that an expert accepts:
             several where two causes give the same curve, as mu = 0 and kt = 0 do. An empty set: nothing is wrong."""
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Mistake:
    name: str
    scene: str                                    # "case2" or "preloaded"
    right: tuple                                  # of frozensets of causes
    code: dict = field(default_factory=dict)      # of aft.Code
    times: dict = field(default_factory=dict)     # numbers of aft.Oscillator: multiplied
    values: dict = field(default_factory=dict)    # ... or replaced
    holds: str = "amplitude"                      # what the column holds
    said: str = "amplitude"                       # what it is said to hold
    value_factor: float = 1.0
    omega_factor: float = 1.0
    points: str = "all"                           # or "outlier", "noise", "unstable", "hopping", "wandering"


def right(*answers):
    return tuple(frozenset(a.split("+")) - {""} for a in answers)


def case2(name, *answers, **how):
    return Mistake("case2_" + name, "case2", right(*answers), **how)


def preloaded(name, *answers, **how):
    return Mistake("preloaded_" + name, "preloaded", right(*answers), **how)


NO_TRACTION = ("no_friction", "no_tangential_stiffness", "no_friction+no_tangential_stiffness")  # the same curve
STATIC = "no_static_harmonic"
SAMPLE = ("slider_restart+too_few_samples", "slider_restart")  # coarse, too: more samples mend both

EQUATIONS = [
    case2("no_mean", STATIC, code={"mean": False}),
    preloaded("no_mean", STATIC, code={"mean": False}),
    case2("odd_only", "odd_harmonics_only", "odd_harmonics_only+" + STATIC, code={"mean": False, "even": False}),
    preloaded("odd_only", "odd_harmonics_only", "odd_harmonics_only+" + STATIC, code={"mean": False, "even": False}),
    case2("h1", "too_few_harmonics", code={"harmonics": 1}),
    case2("h2", "too_few_harmonics", code={"harmonics": 2}),
    case2("h3", "too_few_harmonics", code={"harmonics": 3}, holds="harmonic_1", said="harmonic_1"),
    case2("h5", "too_few_harmonics", code={"harmonics": 5}),
    preloaded("h1", "too_few_harmonics", code={"harmonics": 1}),
    preloaded("h3", "too_few_harmonics", code={"harmonics": 3}),
    case2("n24", "too_few_samples", code={"samples": 24}),
    case2("n32", "too_few_samples", code={"samples": 32}),
    case2("n48", "too_few_samples", code={"samples": 48}),
    case2("h5_n20", "too_few_samples", "too_few_samples+too_few_harmonics", code={"harmonics": 5, "samples": 20}),
    preloaded("n24", "too_few_samples", code={"samples": 24}),
    preloaded("n32", "too_few_samples", code={"samples": 32}),
    preloaded("n48", "too_few_samples", code={"samples": 48}),
    # The slider after a separation: not in the preloaded scene, where it slips at once, wherever it was.
    case2("sample_n64", *SAMPLE, code={"samples": 64, "slider": "sample"}),
    case2("sample_n128", *SAMPLE, code={"samples": 128, "slider": "sample"}),
    case2("single_pass", "single_pass", code={"periods": 1}),
    preloaded("single_pass", "single_pass", code={"periods": 1}),
    case2("zeroed", "slider_zeroed", code={"slider": "zeroed"}),
    case2("kept", "slider_kept", code={"slider": "kept"}),
    case2("no_separation", "no_separation", code={"separates": False}),
    preloaded("no_separation", "no_separation", code={"separates": False}),
    # N = N0 = 0 in case 2: no contact force at all
    case2("constant_normal", "constant_normal_force", "no_contact", code={"normal": "constant"}),
    preloaded("constant_normal", "constant_normal_force", code={"normal": "constant"}),
    preloaded("constant_limit", "constant_normal_force", code={"normal": "constant limit"}),
    preloaded("preload_on", "preload_not_subtracted", code={"preload_off": False}),
    case2("contact_twice", "contact_force_factor", code={"contact_factor": 2.0}),
    case2("contact_half", "contact_force_factor", code={"contact_factor": 0.5}),
    preloaded("contact_twice", "contact_force_factor", code={"contact_factor": 2.0}),
    preloaded("contact_half", "contact_force_factor", code={"contact_factor": 0.5}),
    case2("mean_twice", "mean_factor", code={"mean_factor": 2.0}),
    case2("mean_half", "mean_factor", code={"mean_factor": 0.5}),
    preloaded("mean_twice", "mean_factor", code={"mean_factor": 2.0}),
    preloaded("mean_half", "mean_factor", code={"mean_factor": 0.5}),
    case2("no_contact", "no_contact", code={"contact": "none"}),
    preloaded("no_contact", "no_contact", code={"contact": "none"}),
    # gap = +5 in case 2 is a preload that 100 N do not overcome: stuck for ever
    case2("stuck", "always_stuck", "gap_sign", code={"contact": "stuck"}),
    preloaded("stuck", "always_stuck", code={"contact": "stuck"}),
]

NUMBERS = [
    case2("force_twice", "wrong_force", times={"force": 2.0}),
    preloaded("force_half", "wrong_force", times={"force": 0.5}),
    preloaded("force_7_percent", "wrong_force", times={"force": 1.07}),
    case2("mass_5_percent", "wrong_mass", times={"mass": 1.05}),
    preloaded("mass_twice", "wrong_mass", times={"mass": 2.0}),
    case2("damping_twice", "wrong_damping", times={"damping": 2.0}),
    preloaded("damping_half", "wrong_damping", times={"damping": 0.5}),
    case2("stiffness_10_percent", "wrong_stiffness", times={"stiffness": 1.1}),
    preloaded("stiffness_twice", "wrong_stiffness", times={"stiffness": 2.0}),
    preloaded("kt_twice", "wrong_tangential_stiffness", times={"kt": 2.0}),
    preloaded("kt_half", "wrong_tangential_stiffness", times={"kt": 0.5}),
    case2("kn_twice", "wrong_normal_stiffness", times={"kn": 2.0}),
    case2("kn_tenth", "wrong_normal_stiffness", times={"kn": 0.1}),
    preloaded("kn_twice", "wrong_normal_stiffness", times={"kn": 2.0}),
    preloaded("mu_twice", "wrong_friction", times={"mu": 2.0}),
    preloaded("mu_half", "wrong_friction", times={"mu": 0.5}),
    case2("gap_twice", "wrong_gap", times={"gap": 2.0}),
    preloaded("gap_half", "wrong_gap", times={"gap": 0.5}),
    case2("gap_sign", "gap_sign", "always_stuck", times={"gap": -1.0}),
    preloaded("gap_sign", "gap_sign", times={"gap": -1.0}),
    preloaded("angle_complement", "angle_complement", values={"angle": 60.0}),
    preloaded("angle_in_radians", "angle_unit", values={"angle": 30 * 57.29577951308232}),
    preloaded("angle_in_degrees", "angle_unit", values={"angle": 30 / 57.29577951308232}),
    case2("angle_in_radians", "angle_unit", values={"angle": 45 * 57.29577951308232}),
    # at 0.79 degrees the gap never closes
    case2("angle_in_degrees", "angle_unit", "no_contact", values={"angle": 45 / 57.29577951308232}),
    case2("kt_kn_exchanged", "stiffnesses_exchanged", values={"kt": 1000.0, "kn": 100.0}),
    preloaded("kt_kn_exchanged", "stiffnesses_exchanged", values={"kt": 600.0, "kn": 400.0}),
    case2("no_friction", *NO_TRACTION, values={"mu": 0.0}),
    preloaded("no_friction", *NO_TRACTION, values={"mu": 0.0}),
    preloaded("no_kt", *NO_TRACTION, values={"kt": 0.0}),
]

TWO_PI = 6.283185307179586
W0 = 6.324555320336759  # sqrt(K/M) of both scenes
RMS = ("rms", "rms_without_mean")  # amplitude/sqrt(2): the rms of a sine of that amplitude; neither word is nearer
ACCELERATION = ("acceleration", "acceleration+too_few_harmonics")  # 10 harmonics of x'' are 5 % off

COLUMNS = [
    case2("peak_to_peak", "peak_to_peak", value_factor=2.0),
    preloaded("peak_to_peak", "peak_to_peak", value_factor=2.0, holds="harmonic_1", said="harmonic_1"),
    case2("half", "half_amplitude", value_factor=0.5, holds="harmonic_1", said="harmonic_1"),
    preloaded("half", "half_amplitude", value_factor=0.5),
    case2("over_root_2", *RMS, value_factor=0.7071067811865476),
    preloaded("rms", "rms", holds="rms"),
    case2("rms_without_mean", "rms_without_mean", holds="rms_without_mean"),
    case2("nlvib", "norm_over_root_2", holds="norm_over_root_2"),
    preloaded("nlvib", "norm_over_root_2", holds="norm_over_root_2"),
    case2("norm", "norm", holds="norm"),
    preloaded("norm", "norm", holds="norm"),
    case2("sum_of_moduli", "sum_of_moduli", holds="sum_of_moduli"),
    preloaded("sum_of_moduli", "sum_of_moduli", holds="sum_of_moduli"),
    case2("cosine_only", "cosine_only", holds="cosine", said="harmonic_1"),
    preloaded("sine_only", "sine_only", holds="sine", said="harmonic_1"),
    case2("velocity", "velocity", holds="velocity"),
    preloaded("velocity", "velocity", holds="velocity"),
    case2("acceleration", *ACCELERATION, holds="acceleration"),
    preloaded("acceleration", *ACCELERATION, holds="acceleration"),
    case2("decibel", "decibel", holds="decibel"),
    preloaded("decibel", "decibel", holds="decibel"),
    case2("harmonic_1", "other_quantity", holds="harmonic_1"),
    case2("peak", "other_quantity", holds="peak"),
    preloaded("max", "other_quantity", holds="max"),
    case2("millimetres", "length_unit", value_factor=1e3),
    preloaded("metres", "length_unit", value_factor=1e-3),
    case2("over_force", "value_scale", "length_unit", value_factor=1 / 100),  # 1/F0 is centimetres, too
    preloaded("over_static", "value_scale", value_factor=40 / 100),           # K/F0
    case2("7_percent", "value_scale", value_factor=1.07),
    case2("hertz", "frequency_unit", omega_factor=1 / TWO_PI),
    preloaded("hertz", "frequency_unit", omega_factor=1 / TWO_PI),
    preloaded("radians_twice", "frequency_unit", omega_factor=TWO_PI),
    case2("over_w0", "omega_scale", omega_factor=1 / W0),
    preloaded("over_w0", "omega_scale", omega_factor=1 / W0),
    case2("offset", "frequency_offset", omega_factor=1.001),
    preloaded("offset", "frequency_offset", omega_factor=1.001),
]

POINTS = [
    case2("outlier", "outlier", points="outlier"),
    preloaded("outlier", "outlier", points="outlier"),
    case2("noise", "noise", points="noise"),
    preloaded("noise", "noise", points="noise"),
    case2("unstable", "unstable_branch", points="unstable"),
    preloaded("unstable", "unstable_branch", points="unstable"),
    case2("hopping", "other_branch", points="hopping"),
    preloaded("hopping", "other_branch", points="hopping"),
    case2("wandering", "", points="wandering"),  # all points lie on solutions: nothing is to be blamed
]

TWO = [
    case2("no_mean_hertz", STATIC + "+frequency_unit", code={"mean": False}, omega_factor=1 / TWO_PI),
    preloaded("no_mean_peak_to_peak", STATIC + "+peak_to_peak", code={"mean": False}, value_factor=2.0),
    case2("no_mean_n32", STATIC + "+too_few_samples", code={"mean": False, "samples": 32}),
    case2("no_mean_sample_n64", *(STATIC + "+" + a for a in SAMPLE),
          code={"mean": False, "samples": 64, "slider": "sample"}),
    # most of these numbers are negative: a file of amplitudes is refused until it is said to be in dB
    preloaded("h3_decibel", "too_few_harmonics+decibel", "decibel", code={"harmonics": 3}, holds="decibel"),
    case2("damping_twice_hertz", "wrong_damping+frequency_unit", times={"damping": 2.0}, omega_factor=1 / TWO_PI),
    preloaded("force_twice_millimetres", "wrong_force+length_unit", times={"force": 2.0}, value_factor=1e3),
    preloaded("kt_twice_velocity", "wrong_tangential_stiffness+velocity", times={"kt": 2.0}, holds="velocity"),
    case2("peak_to_peak_noise", "peak_to_peak", "peak_to_peak+noise", value_factor=2.0, points="noise"),
]

# Written after `verify` had been made with the others at hand, to see that it had not learnt the list by heart: other
# numbers, other pairs, and mistakes that it has no word for (no answer is right, any cause named is wrong).
UNSEEN = [
    case2("h4", "too_few_harmonics", code={"harmonics": 4}),
    case2("n40", "too_few_samples", code={"samples": 40}),
    preloaded("n40", "too_few_samples", code={"samples": 40}),
    case2("force_0.8", "wrong_force", times={"force": 0.8}),
    case2("gap_0.8", "wrong_gap", times={"gap": 0.8}),
    preloaded("force_1.3", "wrong_force", times={"force": 1.3}),
    preloaded("gap_1.3", "wrong_gap", times={"gap": 1.3}),
    preloaded("kt_1.3", "wrong_tangential_stiffness", times={"kt": 1.3}),
    preloaded("kn_0.7", "wrong_normal_stiffness", times={"kn": 0.7}),
    preloaded("mu_1.3", "wrong_friction", times={"mu": 1.3}),
    preloaded("mass_0.9", "wrong_mass", times={"mass": 0.9}),
    preloaded("contact_1.5", "contact_force_factor", code={"contact_factor": 1.5}),
    case2("gap_half_rms", "wrong_gap+rms", times={"gap": 0.5}, holds="rms"),
    preloaded("mu_half_peak_to_peak", "wrong_friction+peak_to_peak", times={"mu": 0.5}, value_factor=2.0),
    case2("damping_mass", "wrong_damping+wrong_mass", times={"damping": 1.5, "mass": 1.05}),
    preloaded("kt_mu", "wrong_tangential_stiffness+wrong_friction", times={"kt": 1.5, "mu": 1.5}),
    preloaded("traction_not_projected", code={"traction_projected": False}),
    preloaded("force_late", code={"samples": 64, "late": 1}),
    preloaded("cubic", code={"cubic": 5.0}),
    preloaded("hysteretic", "damping_kind", code={"hysteretic": True}),
]

MISTAKES = EQUATIONS + NUMBERS + COLUMNS + POINTS + TWO + UNSEEN
