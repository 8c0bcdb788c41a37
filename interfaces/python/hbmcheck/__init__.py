"""hbmcheck - is a harmonic-balance result right? Harmonic balance and time integration of an oscillator, or a structure, on
friction and gap contacts, and another program's curve held against both.

    model = hbmcheck.Model.from_yaml("cases/paper/case2.yaml", set={"hbm.harmonics": 20})
    model = hbmcheck.Model(M, C, K, contacts=[...], forcing=[...], sweep=(3, 20))

    model.frf()                        response curve of harmonic balance, or its solutions at given omegas
    model.transient([6, 8])            steady states by time integration
    model.compare([6, 8])              both, with verdicts
    model.verify(omega, amplitude)     a curve of your own, point by point, and the likely cause where it is off
    model.contact_force(u, v)          Fourier coefficients of one contact's forces
    model.modes(), .survey(at), .advise(), .prove(), .gate(), .reduce(folder): as the commands of these names
    model.replace(hbm={"harmonics": 9})    another model, of other settings

The equations are those of interfaces/library/hbmcheck.h. Units: any consistent set; omega is in rad per unit time.
"""
from ._errors import BadInput, Error, Interrupted, MissingFile, Stopped
from ._library import library_version
from .model import Model
from .results import Comparison, ContactForce, Contacts, Curve, Solutions, Table, Transient, Verification

__version__ = "1.0.0"
__all__ = ["BadInput", "Comparison", "ContactForce", "Contacts", "Curve", "Error", "Interrupted", "MissingFile", "Model", "Solutions",
           "Stopped", "Table", "Transient", "Verification", "library_version"]
