/* structure_model.h - the model of a structure. */
#ifndef HC_STRUCTURE_MODEL_H
#define HC_STRUCTURE_MODEL_H

#include "casefile/structure.h"
#include "model/model.h"

/* To free with model_free. The loads of a harmonic are summed: amplitude cos(k omega t + phase) is amplitude
 * cos(phase) cos(k omega t) - amplitude sin(phase) sin(k omega t). A response where the case names none is the DOF that
 * the first load with a harmonic >= 1 acts on most, or else the first one. HC_NO_MEMORY: *out is NULL. */
hc_status structure_model(const scene_structure *s, model **out);

/* Has the contact two tangents? In the model it is two contacts then (contact_pair, model.h). */
bool structure_contact_is_pair(const scene_structure *s, const structure_contact *c);

/* The first of the model's contacts that contact j is, for 0 <= j <= n_contacts: n_contacts gives their number. */
int structure_model_contact(const scene_structure *s, int j);

/* How many responses its model has, and the name of one: that of its direction, into text[size], which is returned. */
int structure_response_count(const scene_structure *s);
const char *structure_response_name(const scene_structure *s, int r, char *text, size_t size);

/* The contact's law: its gap from a preload given instead, or its constant normal force. */
contact structure_contact_law(const structure_contact *c);

/* Cosine and sine of an angle [deg], exact at multiples of 90. */
void structure_cosine_sine(double angle_deg, double *cosine, double *sine);

#endif
