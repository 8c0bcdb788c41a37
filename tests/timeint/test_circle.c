/* test_circle.c - time integration of contacts with two tangents under the law of the circle: against an independent
 * program, against the law of one tangent where the motion is on one line, and against differences. */

#include "numerics/norm.h"
#include "tests/timeint/drawn.h"
#include "timeint/cvode/events_newton.h"
#include "timeint/steady/contact_watch.h"

/* ---- scenes ---------------------------------------------------------------------------------------------- */

/* Contacts j and j + 1 become the two directions of one of that law, under the law of the circle. */
static void make_planar(model *m, int j, contact whole)
{
  for (int a = 0; a < 2; ++a) {
    m->contacts[j + a].law = model_half_law(&whole);
    m->contacts[j + a].pair = a ? CONTACT_SECOND : CONTACT_FIRST;
    m->contacts[j + a].circle = true;
  }
  memcpy(m->contacts[j + 1].normal, m->contacts[j].normal, (size_t)m->n * sizeof(double));
}

/* Two or three masses, tied to the ground and to each other, on one contact of that law; of three the last moves in its
 * normal. */
static model *on_a_plane(int n, double force, contact law)
{
  const double forces[] = {1, 0.6, 0.8}, stiffness[] = {100, 130, 180};
  const double damping[] = {0.29938196180258764, 0.34205262752974136, 0.4020317886097642};
  model *m;
  assert_int_equal(model_new(n, 1, 2, n, &m), HC_OK);
  for (int i = 0; i < n; ++i) {
    m->mass[i * (n + 1)] = 1;
    m->damping[i * (n + 1)] = i == 0 && n == 2 ? 0.3 : damping[i];
    m->stiffness[i * (n + 1)] = stiffness[i];
    m->responses[i * (n + 1)] = 1;
  }
  if (n == 3) {
    m->stiffness[2] = m->stiffness[6] = 15;
    m->damping[2] = m->damping[6] = 0.019246842526345592;
    m->contacts[0].normal[2] = 1;
    m->loads[0].cosine[2] = force * forces[2];
  }
  m->loads[0].harmonic = 1;
  m->loads[0].cosine[0] = force * forces[0];
  m->loads[0].sine[1] = force * forces[1];
  for (int a = 0; a < 2; ++a) m->contacts[a].tangent[a] = 1;
  make_planar(m, 0, law);
  return m;
}

static model *space(double force)
{
  return on_a_plane(3, force, (contact){.kt = 60, .kn = 80, .mu = 0.5, .gap = 0.02});
}
static model *plane(double force) { return on_a_plane(2, force, (contact){.kt = 60, .mu = 0.5, .load = 4}); }

/* Of some masses, with circles, and contacts of other kinds beside them. */
static void draw(uint64_t *seed, transient_law law, drawn *d)
{
  const int n = random_int(seed, 3, 6), circles = random_int(seed, 1, 3);
  d->m = random_structure(seed, n, 2 * circles + random_int(seed, 0, 2));
  for (int j = 0; j < 2 * circles; j += 2) {
    contact whole = {.kt = 10 + 50 * random_unit(seed), .mu = 0.1 + 0.5 * random_unit(seed)};
    random_direction(seed, n, d->m->contacts[j].tangent);
    random_direction(seed, n, d->m->contacts[j + 1].tangent);
    random_direction(seed, n, d->m->contacts[j].normal);
    whole.kn = 10 + 50 * random_unit(seed);
    whole.gap = 0.3 * random_signed(seed);
    if (random_unit(seed) < 0.3) {
      whole.load = 5 * random_unit(seed);
      whole.kn = whole.gap = 0;
      memset(d->m->contacts[j].normal, 0, (size_t)n * sizeof(double));
    }
    make_planar(d->m, j, whole);
  }
  scale_drawn(d, law, 3 + 10 * random_unit(seed));
}

/* ---- an independent program ------------------------------------------------------------------------------ */

/* Steady states from rest of a program of its own: Taylor series of order 22 while a circle slips, events bisected to
 * rounding, in NumPy; good to 1e-11. Rows whose sliders all move. */
static const struct {
  int n; /* 3: in space, 2: in a plane */
  double force, omega;
  int response;
  double amplitude, mean, harmonic_1;
} reference[] = {
    /* clang-format off */
    {3, 0.1, 12.5, 0, 0.0136790116172011, 0.000724043236133596, 0.0136879561564891},
    {3, 0.1, 12.5, 1, 0.00181410775039846, 7.75146925697662e-05, 0.00181517217488898},
    {3, 0.1, 12.5, 2, 0.00200383162676268, -4.17717251615528e-05, 0.0020037274850991},
    {3, 1, 10.5, 0, 0.0535439953208126, 0.000145594800588821, 0.0533298217454501},
    {3, 1, 10.5, 1, 0.0142084038514593, 0.000321527414303714, 0.01413415983186},
    {3, 1, 10.5, 2, 0.00772563094196045, -8.39970003396914e-06, 0.00772308405897151},
    {3, 1, 11.5, 0, 0.0336001099927331, 0.000910392315115997, 0.033515396914202},
    {3, 1, 11.5, 1, 0.0243468479307321, 0.000747495495965546, 0.0242847157299061},
    {3, 1, 11.5, 2, 0.00931823551732377, -5.2522633564384e-05, 0.00931982965755108},
    {3, 1, 12.5, 0, 0.0155771399234322, 5.21682620434959e-05, 0.0156110335537817},
    {3, 1, 12.5, 1, 0.0292448762189366, 0.00234310097454345, 0.0292123763805374},
    {3, 1, 12.5, 2, 0.00943989886224831, -3.00970742558284e-06, 0.00944092697802763},
    {3, 1, 14, 0, 0.0130328884860964, 0.00269917358694105, 0.0130646333873732},
    {3, 1, 14, 1, 0.0167518177043513, 0.00334188074140485, 0.0167477532490597},
    {3, 1, 14, 2, 0.0151625755929662, -0.00015572155309276, 0.0151623809825134},
    {3, 3, 10.5, 0, 0.24502872830832, 0.00271219999637419, 0.244410231283926},
    {3, 3, 10.5, 1, 0.0879392421510023, -0.00217472694412633, 0.0875445456504917},
    {3, 3, 10.5, 2, 0.0439042389487563, -0.00197870379437056, 0.0441126218976901},
    {3, 3, 11.5, 0, 0.0771211403901835, -0.000381938526067969, 0.0769757619545665},
    {3, 3, 11.5, 1, 0.246947262936675, 0.00242985461468712, 0.246575540244544},
    {3, 3, 11.5, 2, 0.0294288389280236, -0.000491645663215775, 0.0295657332379243},
    {3, 3, 12.5, 0, 0.0459114420615086, 0.000108326318462462, 0.0458538754961522},
    {3, 3, 12.5, 1, 0.07220413117475, 0.00510990949954017, 0.0721048434682624},
    {3, 3, 12.5, 2, 0.0331145882132852, -0.000834916707251189, 0.033249678606355},
    {3, 3, 14, 0, 0.0238563460854008, 0.00336775298420364, 0.0238066439540115},
    {3, 3, 14, 1, 0.0430508056011771, 0.00915287015266689, 0.0429695415862398},
    {3, 3, 14, 2, 0.0818341387100293, -0.00617139100039291, 0.0819208131155335},
    {2, 1, 11.5, 0, 0.0380418392726096, 1.00553043422988e-17, 0.0381540149981},
    {2, 1, 11.5, 1, 0.0102528108751847, -7.92906520264253e-17, 0.0102541279064},
    {2, 1, 12.5, 0, 0.0415014453572093, 1.0783073322871e-17, 0.0416335040933467},
    {2, 1, 12.5, 1, 0.0240692972021216, 8.54355082777873e-19, 0.0240957510723961},
    {2, 1, 14, 0, 0.0277081528255064, 4.73192061373878e-17, 0.0276659503379081},
    {2, 1, 14, 1, 0.0375136373049666, 6.49242458170925e-19, 0.0375345383913082},
    {2, 3, 10.5, 0, 0.218832507165932, -2.06238283769267e-18, 0.218011223873292},
    {2, 3, 10.5, 1, 0.060821092713822, -1.56508245989419e-17, 0.0605791488136965},
    {2, 3, 11.5, 0, 0.103362798422168, 1.7952578520478e-17, 0.102970337121194},
    {2, 3, 11.5, 1, 0.0889500456318896, 2.21942240154718e-17, 0.0886364596156571},
    {2, 3, 12.5, 0, 0.0530549322024647, -1.91092438633157e-18, 0.0530395450969353},
    {2, 3, 12.5, 1, 0.076360591654478, 4.42849143499063e-18, 0.0761526222487616},
    {2, 3, 14, 0, 0.0413984783777806, 1.23525926997927e-17, 0.0414481594080007},
    {2, 3, 14, 1, 0.0448735396280941, -4.02549197393246e-17, 0.0448263029769474},
    /* clang-format on */
};
enum { N_REFERENCE = sizeof reference / sizeof *reference };

static const transient_settings closed_form = CLOSED_FORM(1e-10, 20000);

/* Tolerance relative to the largest response of the row's frequency. */
static void check_reference(transient_settings how, double tolerance)
{
  static timeint_result r;
  for (int i = 0; i < N_REFERENCE; i += reference[i].n) {
    model *m = reference[i].n == 3 ? space(reference[i].force) : plane(reference[i].force);
    double state[8] = {0}, largest = 0;
    timeint *ti;
    assert_int_equal(timeint_new(m, &how, &ti), HC_OK);
    assert_int_equal(timeint_steady(ti, reference[i].omega, state, NULL, &r), HC_OK);
    assert_int_equal(r.period_multiple, 1);
    assert_int_equal(r.free_sliders, 0);
    for (int k = i; k < i + reference[i].n; ++k) largest = fmax(largest, reference[k].amplitude);
    for (int k = i; k < i + reference[i].n; ++k) {
      assert_int_equal(timeint_response(ti, reference[k].response, &r), HC_OK);
      CHECK_NEAR(r.amplitude, reference[k].amplitude, tolerance * largest, "row %d", k);
      CHECK_NEAR(r.mean, reference[k].mean, tolerance * largest, "row %d: mean", k);
      CHECK_NEAR(r.harmonic_1, reference[k].harmonic_1, tolerance * largest, "row %d: harmonic 1", k);
    }
    timeint_free(ti);
    model_free(m);
  }
}

static void periods_meet_the_reference(CHECK_STATE) { meet_the_reference(check_reference); }

/* A contact that sticks all the time is one slider that rests anywhere, not two: by shooting, and marched. */
static void a_circle_that_sticks_is_free_once(CHECK_STATE)
{
  static timeint_result r;
  for (int march = 0; march < 2; ++march) {
    model *m = plane(0.08);
    transient_settings how = closed_form;
    double y[6] = {0};
    timeint *ti;
    if (march) how.steady = TRANSIENT_STEADY_MARCH;
    assert_int_equal(timeint_new(m, &how, &ti), HC_OK);
    assert_int_equal(timeint_steady(ti, 12.5, y, NULL, &r), HC_OK);
    assert_int_equal(r.free_sliders, 1);
    timeint_free(ti);
    model_free(m);
  }
}

/* ---- the regularised law --------------------------------------------------------------------------------- */

static void newton_solves_the_equations(CHECK_STATE) { check_newton(draw); }

/* ---- the exact law --------------------------------------------------------------------------------------- */

/* A state of the exact law's equations by CVODE, y = (x, p, z). */
typedef struct between_events {
  drawn d;
  contact_track track[MOST_CONTACTS];
  contact_forces_linear law[MOST_CONTACTS];
  int own_of[MOST_CONTACTS], n, turning;
  double y[MOST];
} between_events;

/* dy at y: forces and rates contact by contact. */
static void rate_between_events(const between_events *b, const double *y, double *dy)
{
  const scaled_model *m = &b->d.scaled;
  const int n = m->n;
  memcpy(dy, y + n, (size_t)n * sizeof *dy);
  scaled_linear_force(m, 1, y, dy + n);
  for (int j = 0; j < m->n_contacts; ++j) {
    const double *t = m->base->tangent + j * n, *normal = m->base->normal + j * n;
    const contact_forces_linear *f = &b->law[j];
    const double u = dot_product(n, t, y), v = dot_product(n, normal, y);
    for (int i = 0; i < n; ++i)
      dy[n + i] -= t[i] * (f->t_u * u + f->t_v * v + f->t_0) + normal[i] * (f->n_v * v + f->n_0);
    if (m->contact[j].direction > 0 || b->own_of[j] < 0) continue;
    const int own = 2 * n + b->own_of[j];
    const contact_motion at = scaled_motion_at(m, j, y);
    const law_pull pull =
        b->track[j].turns ? m->contact[j].kind->pull(&b->track[j], &m->contact[j], &at, y[own]) : (law_pull){{0}, 0};
    dy[own] = pull.rate;
    for (int i = 0; i < n; ++i) dy[n + i] -= pull.t[0] * t[i] + pull.t[1] * t[n + i];
  }
}

/* (I - gamma J) z = r by elimination, J z by differences along z: h^2 of third derivatives, those of 1/|U'|. */
static void newton_of_the_exact_law_solves_its_equations(CHECK_STATE)
{
  uint64_t seed = 27;
  int turning = 0;
  for (int trial = 0; trial < 200; ++trial) {
    between_events b;
    events_newton s;
    workspace memory = {0};
    double z[MOST], r[MOST], f[2][MOST], size = 1;
    draw(&seed, TRANSIENT_LAW_EXACT, &b.d);
    const scaled_model *m = &b.d.scaled;
    b.n = 2 * m->n, b.turning = 0;
    for (int i = 0; i < b.n; ++i) b.y[i] = random_signed(&seed);
    for (int j = 0; j < m->n_contacts; j += scaled_directions(m, j)) {
      const law_kind *kind = m->contact[j].kind;
      const contact_motion at = scaled_motion_at(m, j, b.y);
      const double w[2] = {random_signed(&seed), random_signed(&seed)};
      contact_track_begin(&b.track[j], &m->contact[j], &at, w);
      b.own_of[j] = -1;
      if (!kind->own_begin) continue;
      b.own_of[j] = b.n - 2 * m->n;
      b.y[b.n++] = b.track[j].turns ? kind->own_begin(&b.track[j]) : 0;
      b.turning += b.track[j].turns;
    }
    for (int j = 0; j < m->n_contacts; ++j) b.law[j] = contact_track_forces(&b.track[j], &m->contact[j]);
    const double gamma = pow(10, -4 + 4 * random_unit(&seed)), h = 1e-5;
    turning += b.turning;
    for (int i = 0; i < b.n; ++i) z[i] = r[i] = random_signed(&seed);
    assert_int_equal(events_newton_make(&s, b.d.base, b.track, b.law, b.own_of, &memory), HC_OK);
    events_newton_linearise(&s, &b.d.scaled, b.y);
    assert_true(events_newton_factor(&s, &b.d.scaled, gamma));
    events_newton_solve(&s, z);
    for (int i = 0; i < b.n; ++i) size = fmax(size, fabs(z[i]));
    for (int side = 0; side < 2; ++side) {
      double y[MOST];
      for (int i = 0; i < b.n; ++i) y[i] = b.y[i] + (side ? h : -h) * z[i] / size;
      rate_between_events(&b, y, f[side]);
    }
    for (int i = 0; i < b.n; ++i) {
      const double Jz = (f[1][i] - f[0][i]) * size / (2 * h);
      CHECK_NEAR(z[i] - gamma * Jz, r[i], 1e-5 * (1 + size + gamma * fabs(Jz)), "trial %d, row %d, gamma %g", trial, i,
                 gamma);
    }
    workspace_free(&memory);
    undraw(&b.d);
  }
  CHECK_LE(50, turning, "slips that turn");
}

/* A motion on one line through the plane, along e, is that of the contact whose tangent is e: the same masses with
 * loads along that line, K and C the same in both directions. Rounding of some hundred steps. */
static void a_motion_on_a_line_is_that_of_one_tangent(CHECK_STATE)
{
  const double e[2] = {0.6, 0.8};
  const contact law = {.kt = 60, .kn = 80, .mu = 0.5, .gap = 0.02};
  drawn two = {.m = space(3)}, one = {.m = space(3)};
  integrator *of_two, *of_one;
  double y[2][MOST] = {{0}};
  for (int k = 0; k < 2; ++k) {
    model *m = k ? one.m : two.m;
    memset(m->stiffness, 0, 9 * sizeof(double));
    memset(m->damping, 0, 9 * sizeof(double));
    for (int i = 0; i < 3; ++i) m->stiffness[4 * i] = i < 2 ? 100 : 180, m->damping[4 * i] = 0.3;
    for (int a = 0; a < 2; ++a) {
      m->stiffness[6 + a] = m->stiffness[3 * a + 2] = 15 * e[a];
      m->loads->cosine[a] = 3 * e[a], m->loads->sine[a] = 0;
    }
  }
  memcpy(one.m->contacts[0].tangent, e, sizeof e);
  memset(one.m->contacts[1].tangent, 0, 3 * sizeof(double));
  for (int j = 0; j < 2; ++j) one.m->contacts[j].pair = CONTACT_ALONE, one.m->contacts[j].circle = false;
  one.m->contacts[0].law = law;
  one.m->contacts[1].law = (contact){0};
  scale_drawn(&one, TRANSIENT_LAW_EXACT, 10.5);
  scale_drawn(&two, TRANSIENT_LAW_EXACT, 10.5);
  assert_int_equal(integrate_new_closed_form(one.base, INTERVAL_MODES_STIFF, &of_one), HC_OK);
  assert_int_equal(integrate_new_closed_form(two.base, INTERVAL_MODES_STIFF, &of_two), HC_OK);
  for (int period = 0; period < 5; ++period) {
    double x[2][6];
    assert_int_equal(integrate_period(of_one, &one.scaled, y[0], NULL, NULL), HC_OK);
    assert_int_equal(integrate_period(of_two, &two.scaled, y[1], NULL, NULL), HC_OK);
    modal_base_to_model(one.base, y[0], x[0]);
    modal_base_to_model(two.base, y[1], x[1]);
    modal_base_to_model(one.base, y[0] + 3, x[0] + 3);
    modal_base_to_model(two.base, y[1] + 3, x[1] + 3);
    for (int i = 0; i < 6; ++i) CHECK_NEAR(x[1][i], x[0][i], 1e-13, "period %d, %d", period, i);
    for (int a = 0; a < 2; ++a) CHECK_NEAR(y[1][6 + a], e[a] * y[0][6], 1e-13, "period %d, slider", period);
  }
  assert_true(integrate_transitions(of_one) >= 20);
  assert_int_equal(integrate_transitions(of_one), integrate_transitions(of_two));
  integrate_free(of_one);
  integrate_free(of_two);
  undraw(&one);
  undraw(&two);
}

/* The tangents turned in their plane by an angle, and mirrored: the same motion, to rounding. */
static void turned_tangents_change_nothing(CHECK_STATE)
{
  uint64_t seed = 5;
  for (int trial = 0; trial < 20; ++trial) {
    drawn d, turned;
    integrator *in, *other;
    double y[MOST] = {0}, z[MOST] = {0};
    const double angle = 6 * random_unit(&seed), c = cos(angle), s = sin(angle), mirror = trial % 2 ? -1 : 1;
    draw(&seed, TRANSIENT_LAW_EXACT, &d);
    assert_int_equal(model_copy(d.m, &turned.m), HC_OK);
    for (int j = 0; j < d.m->n_contacts; ++j)
      for (int i = 0; i < d.m->n && d.m->contacts[j].pair == CONTACT_FIRST; ++i) {
        const double one = d.m->contacts[j].tangent[i], two = d.m->contacts[j + 1].tangent[i];
        turned.m->contacts[j].tangent[i] = c * one + s * two;
        turned.m->contacts[j + 1].tangent[i] = mirror * (c * two - s * one);
      }
    scale_drawn(&turned, TRANSIENT_LAW_EXACT, 1 / d.scaled.by_C);
    assert_int_equal(integrate_new_closed_form(d.base, INTERVAL_MODES_STIFF, &in), HC_OK);
    assert_int_equal(integrate_new_closed_form(turned.base, INTERVAL_MODES_STIFF, &other), HC_OK);
    for (int period = 0; period < 3; ++period) {
      double x[MOST], x2[MOST];
      assert_int_equal(integrate_period(in, &d.scaled, y, NULL, NULL), HC_OK);
      assert_int_equal(integrate_period(other, &turned.scaled, z, NULL, NULL), HC_OK);
      modal_base_to_model(d.base, y, x);
      modal_base_to_model(turned.base, z, x2);
      for (int i = 0; i < d.m->n; ++i) CHECK_NEAR(x2[i], x[i], 1e-10, "trial %d, period %d, %d", trial, period, i);
    }
    integrate_free(in);
    integrate_free(other);
    undraw(&d);
    undraw(&turned);
  }
}

/* Column q of phi against differences of the period map, of e and 2 e, extrapolated. Where the order of transitions
 * changes in between the map has one derivative less there, and nothing would be compared: those are few. Sliders that
 * are tied to the motion take the place that the law gives them, in both: what is compared are x, x' and what w does.
 * How many entries are off by more than 1e-7 of the column. */
static int differences_off(const drawn *d, integrator *in, const double *y, const double *phi, int q)
{
  double end[4][MOST], size = 1;
  const int n = d->scaled.n_states;
  int off = 0;
  for (int k = 0; k < 4; ++k) {
    double *z = end[k];
    memcpy(z, y, sizeof end[k]);
    z[q] += (k % 2 ? 1 : -1) * (k < 2 ? 1e-5 : 2e-5);
    assert_int_equal(integrate_period(in, &d->scaled, z, NULL, NULL), HC_OK);
  }
  for (int i = 0; i < n; ++i) size = fmax(size, fabs(phi[i + q * n]));
  for (int i = 0; i < n; ++i) {
    const double one = (end[1][i] - end[0][i]) / 2e-5, two = (end[3][i] - end[2][i]) / 4e-5;
    off += !(fabs(phi[i + q * n] - (4 * one - two) / 3) <= 1e-7 * size);
  }
  return off;
}

/* Only columns of states that no tied slider has to follow: those of x, x' move it off its circle, and the map then
 * has a corner there. So all sliders stick or are apart at theta = 0: the start is taken where that holds. */
static bool is_smooth(const drawn *d, const double *y)
{
  for (int j = 0; j < d->scaled.n_contacts; ++j) {
    const scaled_contact *c = &d->scaled.contact[j];
    double u[2] = {0}, v;
    if (!c->law.has_friction || c->direction > 0) continue;
    scaled_contact_motion(&d->scaled, j, y, u, &v);
    const double n = c->law.kn > 0 ? c->law.kn * (v + c->law.gap) : c->law.load;
    const double *w = y + 2 * d->scaled.n + j,
                 t = c->law.kt * hypot(u[0] - w[0], c->kind->directions > 1 ? u[1] - w[1] : 0);
    if (fabs(n) < 1e-3 || (n > 0 && fabs(t - c->law.mu * n) < 1e-3)) return false;
  }
  return true;
}

static void monodromy_is_the_derivative(CHECK_STATE)
{
  uint64_t seed = 7;
  int compared = 0, off = 0;
  for (int trial = 0; trial < 60; ++trial) {
    drawn d;
    integrator *in;
    double y[MOST] = {0}, z[MOST];
    static double phi[MOST * MOST];
    draw(&seed, TRANSIENT_LAW_EXACT, &d);
    const int n = d.scaled.n_states;
    for (int i = 0; i < n; ++i) y[i] = 0.3 * random_signed(&seed);
    assert_int_equal(integrate_new_closed_form(d.base, INTERVAL_MODES_STIFF, &in), HC_OK);
    memcpy(z, y, sizeof y);
    assert_int_equal(integrate_monodromy(in, &d.scaled, z, phi), HC_OK);
    for (int q = 0; q < n && is_smooth(&d, y); ++q) {
      compared += n;
      off += differences_off(&d, in, y, phi, q);
    }
    integrate_free(in);
    undraw(&d);
  }
  CHECK_LE(2000, compared, "too few");
  CHECK_LE(off, 0.002 * compared, "of %d derivatives", compared);
}

static void series_and_events_agree(CHECK_STATE)
{
  int changing;
  CHECK_LE(40 * 4 * 4, check_series_and_events(draw, 40, 1e-9, &changing), "they change their states");
}

/* A slider that goes round a closed curve in each period has left its place, though it comes back to it and the circle
 * never changes its state; one that sticks has not. */
static void a_slider_that_comes_back_has_travelled(CHECK_STATE)
{
  for (int slips = 0; slips < 2; ++slips) {
    drawn d = {.m = plane(slips ? 40 : 0.1)};
    integrator *by[2];
    double y[2][MOST] = {{0}};
    scale_drawn(&d, TRANSIENT_LAW_EXACT, 10.5);
    assert_int_equal(integrate_new_closed_form(d.base, INTERVAL_MODES_STIFF, &by[0]), HC_OK);
    assert_int_equal(integrate_new_events(d.base, 1e-10, &by[1]), HC_OK);
    for (int k = 0; k < 2; ++k) {
      for (int period = 0; period < 40; ++period)
        assert_int_equal(integrate_period(by[k], &d.scaled, y[k], NULL, NULL), HC_OK);
      const long transitions = integrate_transitions(by[k]);
      assert_int_equal(integrate_period(by[k], &d.scaled, y[k], NULL, NULL), HC_OK);
      assert_int_equal(integrate_transitions(by[k]), transitions);
      for (int a = 0; a < 2; ++a) {
        if (slips) CHECK_LE(0.1, integrate_travel(by[k], a), "integrator %d, direction %d", k, a);
        else CHECK_LE(integrate_travel(by[k], a), 0, "integrator %d, direction %d", k, a);
      }
      integrate_free(by[k]);
    }
    undraw(&d);
  }
}

/* ---- what contacts do ------------------------------------------------------------------------------------- */

/* Over a period of a steady state the loads' work is what damping and friction take: that of the load from the first
 * harmonics, p . x' = omega (sin part), damping's from the waves of three masses, exact but for their aliasing: a sum
 * over TIMEINT_WAVE instants of harmonics that fall off like the sixth power at touch-down. */
static void friction_takes_what_the_loads_give(CHECK_STATE)
{
  static timeint_result r[3];
  const double omegas[] = {10.5, 11.5, 12.5};
  for (int law = 0; law < 2; ++law)
    for (size_t k = 0; k < sizeof omegas / sizeof *omegas; ++k) {
      model *m = space(3);
      transient_settings how = closed_form;
      contact_period p[2];
      timeint *ti;
      double y[8] = {0}, given = 0, damped = 0, largest = 0;
      if (law == 1) {
        how.law = TRANSIENT_LAW_REGULARISED, how.method = TRANSIENT_METHOD_CVODE;
        how.scout = true, how.regularisation = 1e-5, how.tolerance = 1e-8;
      }
      assert_int_equal(timeint_new(m, &how, &ti), HC_OK);
      assert_int_equal(timeint_steady(ti, omegas[k], y, NULL, &r[0]), HC_OK);
      r[1] = r[2] = r[0];
      for (int i = 0; i < 3; ++i) assert_int_equal(timeint_response(ti, i, &r[i]), HC_OK);
      assert_int_equal(timeint_contacts(ti, &r[0], p), HC_OK);
      for (int i = 0; i < 3; ++i) given += PI * (m->loads->cosine[i] * r[i].b1 - m->loads->sine[i] * r[i].a1);
      for (int h = 1; h < 60; ++h) { /* pi omega sum h^2 C_ij (a_i a_j + b_i b_j) */
        double a[3] = {0}, b[3] = {0};
        for (int i = 0; i < 3; ++i)
          for (int t = 0; t < TIMEINT_WAVE; ++t) {
            const double angle = 2 * PI * ((t * h) % TIMEINT_WAVE) / TIMEINT_WAVE;
            a[i] += 2 * r[i].wave[t] * cos(angle) / TIMEINT_WAVE;
            b[i] += 2 * r[i].wave[t] * sin(angle) / TIMEINT_WAVE;
          }
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            damped += PI * omegas[k] * h * h * m->damping[3 * i + j] * (a[i] * a[j] + b[i] * b[j]);
      }
      CHECK_NEAR(p[0].work + p[1].work, given - damped, (law ? 1e-4 : 1e-8) * given, "at %g", omegas[k]);
      CHECK_LE(p[1].work + p[1].slip_distance + p[1].traction_max, 0, "the first direction has it all");
      largest = 0.5 * (p[0].normal_max + p[1].normal_max);
      assert_true(p[0].regime == p[1].regime && p[0].regime == CONTACT_SEPARATES);
      CHECK_LE(p[0].traction_max, largest * (1 + (law ? 1e-3 : 1e-12)), "T of mu 0.5 times N");
      timeint_free(ti);
      model_free(m);
    }
}

static bool stop_at_three(void *self, double done) { return (void)done, ++*(int *)self < 3; }

/* With mu N/kt = 8e-7 against a motion of some 0.05 the direction of slip follows in steps of some 1e-5 of the period.
 * The monitor is asked at the start of a period, then once in 4096 steps, and no longer period comes to its end. */
static void a_long_period_hears_the_monitor(CHECK_STATE)
{
  static timeint_result r;
  for (int cvode = 0; cvode < 2; ++cvode) {
    model *m = on_a_plane(2, 3, (contact){.kt = 60, .mu = 0.5, .load = 1e-4});
    transient_settings how = closed_form;
    int ticks = 0;
    const hc_monitor stop = {.tick = stop_at_three, .self = &ticks};
    double y[6] = {0.1, 0.1};
    timeint *ti;
    if (cvode) how.method = TRANSIENT_METHOD_CVODE;
    assert_int_equal(timeint_new(m, &how, &ti), HC_OK);
    assert_int_equal(timeint_orbit(ti, 12.5, 1, y, &stop, &r), HC_INTERRUPTED);
    CHECK_LE(cvode ? r.rhs : r.steps, 2 * 4096 + 1, "by CVODE: %d", cvode);
    CHECK_LE(r.periods, 0, "none has ended, by CVODE: %d", cvode);
    timeint_free(ti);
    model_free(m);
  }
}

CHECK_TESTS("timeint.circle", 600, periods_meet_the_reference, a_circle_that_sticks_is_free_once,
            newton_solves_the_equations, newton_of_the_exact_law_solves_its_equations,
            a_motion_on_a_line_is_that_of_one_tangent, turned_tangents_change_nothing, monodromy_is_the_derivative,
            series_and_events_agree, a_slider_that_comes_back_has_travelled, friction_takes_what_the_loads_give,
            a_long_period_hears_the_monitor)
