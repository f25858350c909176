"""Sums over the samples of long records, in blocks: products of long arrays would go to several threads.

For sums as cheap as these the threads only wait for each other: up to a thousand times as long as the sum
takes, where the machine has other work.

Not for: solving what is summed.
"""

from __future__ import annotations

import numpy as np

from swayless.plant.identification.record import FloatArray

_BLOCK = 512


def sum_of_squares(values: FloatArray) -> float:
    """Give the sum of the squares of an array, shape (n,).

    Examples
    --------
    >>> sum_of_squares(np.array([3.0, 4.0]))
    25.0
    """
    return float(np.einsum("i,i", values, values))


def inner_products(columns: FloatArray, values: FloatArray) -> FloatArray:
    """Give the products of each column, shape (n, k), with each of other ones, shape (n, m) or (n,).

    Examples
    --------
    >>> inner_products(np.eye(2), np.array([[1.0, 2.0], [3.0, 4.0]]))
    array([[1., 2.],
           [3., 4.]])
    """
    others = values.reshape(values.shape[0], -1)
    whole = columns.shape[0] - columns.shape[0] % _BLOCK
    left, right = (
        array[:whole].T.reshape(array.shape[1], -1, _BLOCK).transpose(1, 0, 2) for array in (columns, others)
    )
    products = (left @ right.transpose(0, 2, 1)).sum(axis=0) + columns[whole:].T @ others[whole:]
    return np.asarray(products.reshape(columns.shape[1], *values.shape[1:]))
