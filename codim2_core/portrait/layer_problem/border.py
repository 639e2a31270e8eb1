"""Distance of an e-linear critical set from the equator without cancellation: ``det(A)^2 - |adj(A) f|^2``."""

from __future__ import annotations

from typing import Any

from ...numerics.double_double import add_pairs, negative, product, square

CANCELS = 0.05  # of the terms of a difference: below it, it is computed in twice the precision


def to_all_digits(m11: Any, m12: Any, m21: Any, m22: Any, f1: Any, f2: Any) -> tuple[Any, Any, Any, Any]:
    """Return the gap ``det(A)^2 - |n|^2``, det A and n = adj(A) f, in twice the precision before they are rounded.

    Shapes: m11, m12, m21, m22, f1, f2 (k,).
    """
    det = add_pairs(product(m11, m22), negative(product(m12, m21)))
    n1 = add_pairs(product(m22, f1), negative(product(m12, f2)))
    n2 = add_pairs(product(m11, f2), negative(product(m21, f1)))
    gap = add_pairs(square(det), negative(add_pairs(square(n1), square(n2))))
    return gap[0], det[0], n1[0], n2[0]
