// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/vector_code.h>

#include <cmath>

/// A number for each of `N` cells, and vectors of such numbers. Loops have a fixed length, so that compilers
/// vectorise them. Internal to this folder.
namespace lacuna::quality {

template <int N>
struct Lanes {
    alignas(8 * N) double v[N];

    LACUNA_INLINE static Lanes all(double value)
    {
        Lanes r;
        for (int i = 0; i < N; ++i) r.v[i] = value;
        return r;
    }
    LACUNA_INLINE friend Lanes operator+(const Lanes& a, const Lanes& b)
    {
        Lanes r;
        for (int i = 0; i < N; ++i) r.v[i] = a.v[i] + b.v[i];
        return r;
    }
    LACUNA_INLINE friend Lanes operator-(const Lanes& a, const Lanes& b)
    {
        Lanes r;
        for (int i = 0; i < N; ++i) r.v[i] = a.v[i] - b.v[i];
        return r;
    }
    LACUNA_INLINE friend Lanes operator*(const Lanes& a, const Lanes& b)
    {
        Lanes r;
        for (int i = 0; i < N; ++i) r.v[i] = a.v[i] * b.v[i];
        return r;
    }
    LACUNA_INLINE friend Lanes operator/(const Lanes& a, const Lanes& b)
    {
        Lanes r;
        for (int i = 0; i < N; ++i) r.v[i] = a.v[i] / b.v[i];
        return r;
    }
    LACUNA_INLINE friend Lanes operator*(double a, const Lanes& b) { return all(a) * b; }
};

/// The smaller number; `b` if one is NaN.
template <int N>
LACUNA_INLINE Lanes<N> least(const Lanes<N>& a, const Lanes<N>& b)
{
    Lanes<N> r;
    for (int i = 0; i < N; ++i) r.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i];
    return r;
}

template <int N>
LACUNA_INLINE Lanes<N> greatest(const Lanes<N>& a, const Lanes<N>& b)
{
    Lanes<N> r;
    for (int i = 0; i < N; ++i) r.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i];
    return r;
}

template <int N>
LACUNA_INLINE Lanes<N> magnitude(const Lanes<N>& a)
{
    Lanes<N> r;
    for (int i = 0; i < N; ++i) r.v[i] = std::abs(a.v[i]);
    return r;
}

template <int N>
LACUNA_INLINE Lanes<N> root(const Lanes<N>& a)
{
    Lanes<N> r;
    for (int i = 0; i < N; ++i) r.v[i] = std::sqrt(a.v[i]);
    return r;
}

template <int N>
LACUNA_INLINE Lanes<N> cube_root(const Lanes<N>& a)
{
    Lanes<N> r;
    for (int i = 0; i < N; ++i) r.v[i] = std::cbrt(a.v[i]);
    return r;
}

/// `yes` in lanes where `a` > `limit`, else `no`.
template <int N>
LACUNA_INLINE Lanes<N> where_above(const Lanes<N>& a, double limit, const Lanes<N>& yes, double no)
{
    Lanes<N> r;
    for (int i = 0; i < N; ++i) r.v[i] = a.v[i] > limit ? yes.v[i] : no;
    return r;
}

template <int N>
struct Vectors {
    Lanes<N> x, y, z;

    LACUNA_INLINE friend Vectors operator+(const Vectors& a, const Vectors& b)
    {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    LACUNA_INLINE friend Vectors operator-(const Vectors& a, const Vectors& b)
    {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    LACUNA_INLINE friend Vectors operator*(double a, const Vectors& b) { return {a * b.x, a * b.y, a * b.z}; }
};

template <int N>
LACUNA_INLINE Lanes<N> dot(const Vectors<N>& a, const Vectors<N>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <int N>
LACUNA_INLINE Vectors<N> cross(const Vectors<N>& a, const Vectors<N>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <int N>
LACUNA_INLINE Lanes<N> determinant(const Vectors<N>& a, const Vectors<N>& b, const Vectors<N>& c)
{
    return dot(a, cross(b, c));
}

} // namespace lacuna::quality
