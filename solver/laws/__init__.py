"""Constitutive laws, a module each.

A law is a tuple of parameters, with ``bulk_modulus`` and ``shear_modulus`` (Pa) among them, and a function of one point
that ``registry.constitutive_law`` enters under a name. Every module of this package is loaded with it, so that a new
law is a new file.
"""

import importlib
import pkgutil

for _module in pkgutil.iter_modules(__path__, f"{__name__}."):
    importlib.import_module(_module.name)
