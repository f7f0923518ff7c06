// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of 106 bits as unevaluated sums of two doubles, for the few programs whose Schur systems are too
/// ill-conditioned for 53: portable, unlike quadruple precision of compilers, and some twenty times slower
/// than double.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace drystone
{

struct DoubleDouble;

namespace doubleDouble
{

/// a + b and its rounding error, for |a| >= |b| or a = 0.
DoubleDouble quickSum(double a, double b);

/// Likewise for any a and b.
DoubleDouble sum(double a, double b);

/// a b and its rounding error.
DoubleDouble product(double a, double b);

} // namespace doubleDouble

/// high + low with |low| at most half a unit in the last place of high. Sums and products after Dekker (1971,
/// Numer. Math. 18, 224-242) in the form of Hida, Li & Bailey (2001, ARITH-15): relative errors of some
/// 2^-104. Range of double; where that is exceeded the result is not finite. Must not be compiled with
/// reassociation of sums (-ffast-math).
struct DoubleDouble
{
    double high = 0;
    double low = 0;

    constexpr DoubleDouble() = default;
    constexpr DoubleDouble(double value) : high(value) {} // exact, hence not explicit
    constexpr DoubleDouble(double larger, double smaller) : high(larger), low(smaller) {}

    explicit operator double() const { return high; }

    // Operators are friends that are found by their arguments alone: outside the struct the compiler would
    // try them, and the conversion from double, on every sum of Eigen's in this namespace (15% of its time of
    // reading conic).

    friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }

    friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b)
    {
        DoubleDouble larger = doubleDouble::sum(a.high, b.high);
        const DoubleDouble smaller = doubleDouble::sum(a.low, b.low);
        larger = doubleDouble::quickSum(larger.high, larger.low + smaller.high);
        return doubleDouble::quickSum(larger.high, larger.low + smaller.low);
    }

    friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }

    friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b)
    {
        const DoubleDouble whole = doubleDouble::product(a.high, b.high);
        return doubleDouble::quickSum(whole.high, whole.low + (a.high * b.low + a.low * b.high));
    }

    /// Three digits of a long division.
    friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b)
    {
        const double first = a.high / b.high;
        DoubleDouble rest = a - b * first;
        const double second = rest.high / b.high;
        rest = rest - b * second;
        const double third = rest.high / b.high;
        return doubleDouble::quickSum(first, second) + third;
    }

    DoubleDouble& operator+=(const DoubleDouble& other) { return *this = *this + other; }
    DoubleDouble& operator-=(const DoubleDouble& other) { return *this = *this - other; }
    DoubleDouble& operator*=(const DoubleDouble& other) { return *this = *this * other; }
    DoubleDouble& operator/=(const DoubleDouble& other) { return *this = *this / other; }

    friend bool operator<(const DoubleDouble& a, const DoubleDouble& b)
    {
        return a.high < b.high || (a.high == b.high && a.low < b.low);
    }
    friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
    friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b)
    {
        return a < b || (a.high == b.high && a.low == b.low);
    }
    friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }
    friend bool operator==(const DoubleDouble& a, const DoubleDouble& b)
    {
        return a.high == b.high && a.low == b.low;
    }
};

namespace doubleDouble
{

inline DoubleDouble quickSum(double a, double b)
{
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

inline DoubleDouble sum(double a, double b)
{
    const double whole = a + b;
    const double part = whole - a;
    return {whole, (a - (whole - part)) + (b - part)};
}

inline DoubleDouble product(double a, double b)
{
    const double whole = a * b;
    return {whole, std::fma(a, b, -whole)};
}

} // namespace doubleDouble

inline DoubleDouble abs(const DoubleDouble& value)
{
    return value.high < 0 ? -value : value;
}

inline bool isfinite(const DoubleDouble& value)
{
    return std::isfinite(value.high);
}

/// One of Newton's steps for the inverse root, from that in double (Karp & Markstein 1997).
inline DoubleDouble sqrt(const DoubleDouble& value)
{
    if (!(value.high > 0))
    {
        return std::sqrt(value.high);
    }
    const double inverse = 1 / std::sqrt(value.high);
    const double root = value.high * inverse;
    const DoubleDouble rest = value - doubleDouble::product(root, root);
    return doubleDouble::sum(root, rest.high * inverse / 2);
}

/// The leading double of a number of either precision.
inline double leading(double value)
{
    return value;
}
inline double leading(const DoubleDouble& value)
{
    return value.high;
}

} // namespace drystone

namespace Eigen
{

template<>
struct NumTraits<drystone::DoubleDouble> : GenericNumTraits<drystone::DoubleDouble>
{
    using Real = drystone::DoubleDouble;
    using NonInteger = drystone::DoubleDouble;
    using Nested = drystone::DoubleDouble;
    using Literal = double;
    enum
    {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 1,
        ReadCost = 2,
        AddCost = 20,
        MulCost = 10
    };
    static Real epsilon() { return std::ldexp(1.0, -104); }
    static Real dummy_precision() { return 1e-28; }
    static int digits10() { return 31; }
};

} // namespace Eigen
