# SPDX-License-Identifier: BSD-3-Clause
"""From humidity to cloud: saturation, cloud fraction after Sundqvist, condensate, and overlap."""
import numpy as np

from .sphere import smoothstep

EPSILON = 0.622  # ratio of the gas constants of dry air and vapour
VIRTUAL = 1.0 / EPSILON - 1.0  # Tv = T (1 + VIRTUAL q)


def ice_share(temperature):
    """The share of ice in the condensate: none above 0 C, all below -38 C."""
    return 1.0 - smoothstep(235.15, 273.15, temperature)


def saturation_humidity(temperature, pressure):
    """Specific humidity (kg/kg) at saturation, over water and ice in the mixture of `ice_share`.

    Vapour pressure by the Magnus form of Alduchov and Eskridge (1996), eqs. 21 and 23 (Pa, degrees C).
    """
    celsius = temperature - 273.15
    water = 610.94 * np.exp(17.625 * celsius / (celsius + 243.04))
    ice = 611.21 * np.exp(22.587 * celsius / (celsius + 273.86))
    share = ice_share(temperature)
    vapour = np.minimum(share * ice + (1.0 - share) * water, 0.5 * pressure)
    return EPSILON * vapour / (pressure - (1.0 - EPSILON) * vapour)


def critical_humidity(sigma, unresolved):
    """RHcrit of a level whose pressure is `sigma` times that of the ground: high near the ground, lower aloft, and
    lower the larger the share of the irregularities' variance, `unresolved`, that lies within a grid box."""
    return 0.71 - 0.14 * unresolved + 0.17 * sigma**3 + 0.04 * (1.0 - smoothstep(0.12, 0.35, sigma))


def cloud_fraction(relative_humidity, critical):
    """Sundqvist, Berge and Kristjansson (1989), eq. 3.13: 1 - sqrt((1 - RH)/(1 - RHcrit)), 0 below RHcrit."""
    dryness = np.clip((1.0 - relative_humidity) / (1.0 - critical), 0.0, 1.0)
    return 1.0 - np.sqrt(dryness)


def condensate(fraction, temperature, saturation):
    """Grid-box means of cloud liquid and ice (kg/kg).

    Within the cloud the condensate is 4.5 % of the saturation humidity, at most 0.35 g/kg: a plausible
    value and no more, of the size that climate models have.
    """
    within = 3.5e-4 * (1.0 - np.exp(-0.045 * saturation / 3.5e-4))
    total = fraction * within
    ice = total * ice_share(temperature)
    return total - ice, ice


def total_cover(fraction):
    """Total cloud cover by maximum-random overlap of adjacent levels (axis 0); Geleyn and Hollingsworth (1979)."""
    clear = 1.0 - np.minimum(fraction[0], 0.999)
    for above, here in zip(fraction[:-1], fraction[1:]):
        above = np.minimum(above, 0.999)
        clear = clear * (1.0 - np.maximum(above, here)) / (1.0 - above)
    return 1.0 - np.clip(clear, 0.0, 1.0)
