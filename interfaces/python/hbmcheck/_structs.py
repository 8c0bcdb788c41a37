"""The structs of hbmcheck.h, field by field in its order; tests/python holds sizes and offsets against the C compiler's."""
from ctypes import CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_int, c_long, c_void_p

TICK = CFUNCTYPE(c_int, c_void_p, c_double)


_TYPES = {"double": c_double, "int": c_int, "long": c_long, "double*": POINTER(c_double), "char*": c_char_p,
          "void*": c_void_p, "tick": TICK}


def _struct(name, *fields):
    """A Structure: 'double a b c', 'int d', ... in a row."""
    listed = [(n, _TYPES[kind]) for kind, *names in (f.split() for f in fields) for n in names]
    return type(name, (Structure,), {"_fields_": listed})


Monitor = _struct("Monitor", "tick tick", "void* self")
Solution = _struct(
    "Solution", "double omega amplitude max min rms mean harmonic_1 multiplier residual",
    "int stable branch harmonics iterations contact mean_free")
Special = _struct("Special", "double omega amplitude", "int branch kind before after")
Summary = _struct(
    "Summary", "double peak_omega peak_amplitude peak_harmonic_1", "int points turning_points harmonics samples rejected",
    "long iterations evaluations", "int reached_end left_at_start inaccurate")
Steady = _struct(
    "Steady", "int status without_hbm", "double omega amplitude max min rms mean harmonic_1 closure multiplier",
    "double from_regularisation", "int stable period_multiple periods", "long steps", "int free_sliders left_orbit",
    "int response contact")
Row = _struct(
    "Row", "double omega", "int verdict hbm_status transient_status orbit_status branch stable period_multiple accounted",
    "double multiplier hbm_amplitude transient_amplitude orbit_amplitude",
    "double amplitude_error harmonic_1_error mean_error waveform_error orbit_error",
    "double from_aliasing from_truncation from_regularisation from_integration from_settling",
    "double hbm_predicted transient_predicted", "int unexpected mean_free response still family")
ContactPeriod = _TYPES["period"] = _struct(
    "ContactPeriod", "double normal_min normal_max traction_max slip_distance work", "int regime")
ContactRow = _struct(
    "ContactRow", "period hbm transient", "double work_error normal_error",
    "int compared differs hbm_status transient_status")
Gate = _struct("Gate", "int checks failed errors exit_code not_applicable")
Foreign = _struct("Foreign", "int response", "char* quantity", "int n", "double* omega value", "double noise")
Point = _struct("Point", "double omega value nearest error", "int verdict index branch stable skipped")
Findings = _struct(
    "Findings", "int points match differs unstable other_branch solver_failed skipped left_out reversals harmonics",
    "int checked unchecked exit_code", "double gate checked_error truth_distance noise")
Hypothesis = _struct(
    "Hypothesis", "double distance omega_factor value_factor", "int harmonics keep_mean samples slider_restart")
