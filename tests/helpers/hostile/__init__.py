"""
A hostile file for each library that parses a stranger's file: it runs a program, reads a secret, swells, or has no end.

`write` makes them in a campaign's folder, beside which the secrets are. What each would do is in its function's first
line. None of them may do it.
"""

from hostile.documents import open_document_entity, pickle_as_text, text_formulas, workbook_entity, workbook_of_97
from hostile.measurement import diadem_elsewhere, diadem_entity, tdms_index
from hostile.place import SECRET, Hostile, Place, secrets
from hostile.scientific import (
    hdf5_swelling,
    matlab_elsewhere,
    matlab_swelling,
    netcdf_classic,
    netcdf_elsewhere,
    numpy_object,
)
from hostile.seismic import gse, mini_seed, seismic_pickle

__all__ = ["FILES", "SECRET", "Hostile", "Place", "secrets"]

FILES = {
    writer.__name__: writer
    for writer in (
        *(seismic_pickle, pickle_as_text, numpy_object, mini_seed, gse, tdms_index, netcdf_elsewhere),
        *(matlab_elsewhere, hdf5_swelling, matlab_swelling, netcdf_classic, workbook_entity, open_document_entity),
        *(workbook_of_97, diadem_entity, diadem_elsewhere, text_formulas),
    )
}
