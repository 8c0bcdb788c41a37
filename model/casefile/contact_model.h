/* contact_model.h - a contact as a case gives it, and the contacts of the model that it is. */
#pragma once

#include "model/model.h"
#include "model/moving_contact.h"

enum { SCENE_NAME = 32 };

/* How a contact with two tangents limits its traction (T_1, T_2): as a vector, or each direction alone. */
typedef enum contact_limit { CONTACT_LIMIT_CIRCLE, CONTACT_LIMIT_SQUARE } contact_limit;

/* A contact's law in the case: one of contact_smooth, or of these, which are several contacts in the model. A table is
 * as many unilateral springs as it has kinks. */
enum { SCENE_LAW_TABLE = CONTACT_LAWS };
enum { SCENE_MOST_POINTS = 32 };

typedef struct scene_contact {
  contact law;           /* as it was given: scene_contact_law */
  double angle_deg;      /* [deg] -90..90, of the contact's tangent to x */
  double preload;        /* [force] >= 0: kn gap, or without kn the constant normal force */
  char name[SCENE_NAME]; /* of a structure's contact, or "" */
  contact_limit limit;   /* of a structure's contact with two tangents */
  int kind;
  double rest[2]; /* [length] where the slider of each tangent begins */
  int n_points;
  double points[SCENE_MOST_POINTS][2]; /* [length] ascending, [force] of a table */
} scene_contact;

/* The law in the model, its gap or constant normal force from a preload given instead; of a composed one nothing. */
contact scene_contact_law(const scene_contact *c);
static inline bool scene_contact_is_composed(const scene_contact *c) { return c->kind >= CONTACT_LAWS; }

/* A table's contacts in the model: how many, 1 of any other law; the stiffness of the spring that is left beside them;
 * and these, along direction[n]. f(0) is taken as held by the rest position, as N0 is. */
int scene_contact_parts(const scene_contact *c);
double scene_contact_slope(const scene_contact *c);
double scene_contact_stiffness(const scene_contact *c, bool at_rest); /* with all of them; at_rest: closed at d = 0 */
void scene_contact_put(const scene_contact *c, int n, const double *direction, model_contact *to);
double scene_contact_table(const scene_contact *c, double d); /* f(d) [force] */

/* The contact with its direction to x; not of a table. */
moving_contact scene_moving_contact(const scene_contact *c);

/* Does a polynomial push back, somewhere; at_rest: from both sides, far out? False of other laws. */
bool scene_contact_restores(const scene_contact *c, bool at_rest);
