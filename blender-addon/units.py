# SPDX-License-Identifier: GPL-3.0-or-later
"""How Blender's radiometric numbers become photometric ones."""

# Luminous efficacy [lm/W] by which every emission in Blender's watts is multiplied; Cycles' own constant for light profiles.
LUMENS_PER_WATT = 177.83
