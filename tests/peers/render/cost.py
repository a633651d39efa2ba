"""What a picture costs: relative variance times seconds. Half the cost is the same noise in half the time."""

from dataclasses import dataclass

import compare
import numpy
from peer import Picture

LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])
# The share of pixels with the most variance that is left out, on all sides alike, and printed: fireflies.
OUTLIERS = 0.001


@dataclass(frozen=True)
class Cost:
    """Of two pictures with different seeds; the variances are means over pixels, relative to the squared luminance."""

    variance: float
    # With the outliers.
    whole_variance: float
    # The least variance among the outliers.
    outliers_from: float
    seconds: float
    processor: float
    samples: int

    @property
    def cost(self) -> float:
        """Relative variance times seconds of the clock."""
        return self.variance * self.seconds

    @property
    def sample_variance(self) -> float:
        """The relative variance of one sample, as if they were independent."""
        return self.variance * self.samples

    @property
    def whole_cost(self) -> float:
        """The same with the outliers."""
        return self.whole_variance * self.seconds

    @property
    def processor_cost(self) -> float:
        """Relative variance times seconds of the processor, which other work on the machine disturbs less."""
        return self.variance * self.processor


def cost(first: Picture, second: Picture, reference: numpy.ndarray) -> Cost:
    """The cost of a picture like these two; `reference` (height, width, 3) is what is best known of the scene, the same for all."""
    known = reference @ LUMINANCE
    known = known + compare.FLOOR * known.mean()
    # The difference of two has twice the variance of one.
    variance = numpy.sort(0.5 * (((first.values - second.values) @ LUMINANCE / known) ** 2).ravel())
    kept = variance.size - round(OUTLIERS * variance.size)
    seconds, processor = 0.5 * (first.seconds + second.seconds), 0.5 * (first.processor + second.processor)
    return Cost(float(variance[:kept].mean()), float(variance.mean()), float(variance[kept - 1]), seconds, processor, first.samples)
