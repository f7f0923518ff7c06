// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Four doubles that are reckoned with as if they were one: what is written for a number of either precision
/// then does the same for four round cones at once, in one register where the processor has such.
#pragma once

#include "linear/DoubleDouble.h"

namespace drystone
{

/// Of each of four comparisons whether it holds: all bits or none.
struct ChoiceOfFour
{
    typedef long Bits __attribute__((vector_size(32), aligned(16)));
    Bits bits;
};

/// Every operation works on each of the four by itself, to the same bits as on a double. Operators are
/// friends for the reason of DoubleDouble.
struct FourDoubles
{
    /// Aligned as Eigen has it on processors without such registers, too.
    typedef double Numbers __attribute__((vector_size(32), aligned(16)));

    Numbers numbers = {};

    FourDoubles() = default;
    FourDoubles(double value) : numbers{value, value, value, value} {} // exact, hence not explicit
    FourDoubles(double one, double two, double three, double four) : numbers{one, two, three, four} {}
    explicit FourDoubles(const Numbers& values) : numbers(values) {}

    double operator[](int at) const { return numbers[at]; }

    friend FourDoubles operator-(const FourDoubles& a) { return FourDoubles(-a.numbers); }
    friend FourDoubles operator+(const FourDoubles& a, const FourDoubles& b)
    {
        return FourDoubles(a.numbers + b.numbers);
    }
    friend FourDoubles operator-(const FourDoubles& a, const FourDoubles& b)
    {
        return FourDoubles(a.numbers - b.numbers);
    }
    friend FourDoubles operator*(const FourDoubles& a, const FourDoubles& b)
    {
        return FourDoubles(a.numbers * b.numbers);
    }
    friend FourDoubles operator/(const FourDoubles& a, const FourDoubles& b)
    {
        return FourDoubles(a.numbers / b.numbers);
    }
    friend ChoiceOfFour operator>(const FourDoubles& a, const FourDoubles& b)
    {
        return {a.numbers > b.numbers};
    }

    FourDoubles& operator+=(const FourDoubles& other) { return *this = *this + other; }
    FourDoubles& operator-=(const FourDoubles& other) { return *this = *this - other; }
    FourDoubles& operator*=(const FourDoubles& other) { return *this = *this * other; }
    FourDoubles& operator/=(const FourDoubles& other) { return *this = *this / other; }
};

inline FourDoubles sqrt(const FourDoubles& value)
{
    using Four = Eigen::Array<double, 4, 1>;
    FourDoubles root;
    Four::Map(reinterpret_cast<double*>(&root.numbers)) =
        Four::Map(reinterpret_cast<const double*>(&value.numbers)).sqrt();
    return root;
}

/// The one where the condition holds, else the other.
inline FourDoubles choose(const ChoiceOfFour& condition, const FourDoubles& one, const FourDoubles& other)
{
    return FourDoubles(condition.bits ? one.numbers : other.numbers);
}
template<class Number>
Number choose(bool condition, const Number& one, const Number& other)
{
    return condition ? one : other;
}

template<class Number>
Number larger(const Number& a, const Number& b)
{
    return choose(a > b, a, b);
}
template<class Number>
Number smaller(const Number& a, const Number& b)
{
    return choose(a > b, b, a);
}

/// What is written for numbers of either precision leaves four as they are where it takes the leading double.
inline const FourDoubles& leading(const FourDoubles& numbers)
{
    return numbers;
}

/// How many numbers one is, and one of them.
template<class Number>
constexpr int countOf = 1;
template<>
inline constexpr int countOf<FourDoubles> = 4;
template<class Number>
const Number& oneOf(const Number& number, int)
{
    return number;
}
inline double oneOf(const FourDoubles& numbers, int at)
{
    return numbers[at];
}

/// As many as a number is, so far apart in memory.
template<class Number>
struct Gathered
{
    static const Number& from(const Number* first, int) { return *first; }
};
template<>
struct Gathered<FourDoubles>
{
    static FourDoubles from(const double* first, int apart)
    {
        return {first[0], first[apart], first[2 * apart], first[3 * apart]};
    }
};

} // namespace drystone

namespace Eigen
{

template<>
struct NumTraits<drystone::FourDoubles> : GenericNumTraits<double>
{
    using Real = drystone::FourDoubles;
    using NonInteger = drystone::FourDoubles;
    using Nested = drystone::FourDoubles;
    using Literal = double;
    enum
    {
        RequireInitialization = 1
    };
};

} // namespace Eigen
