// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Products pair by pair of bodies, in shares for threads; what two shares add to is summed apart.
#include "conic/form/FormOperators.h"

#include "conic/form/FormColumns.h"
#include "core/Threads.h"

namespace drystone
{

template<int Rows, class Scalar>
void applyTransposed(const Form<Rows>& form, const VectorOf<Scalar>& y, VectorOf<Scalar>& out)
{
    const ConeRanges cones = form.cones();
    out.resize(cones.size());
    const auto close = [&](int begin, int end)
    {
        for (int at = begin; at < end; ++at)
        {
            const typename Form<Rows>::Group& group = form.groups[at];
            const ColumnOf<Rows, Scalar> closing = closingOf<Rows, Scalar>(group, y);
            for (int ray = group.begin; ray < group.end; ++ray)
            {
                out[ray] = rayOf<Rows, Scalar>(form, ray).dot(closing);
            }
            for (int round = group.beginRound; round < group.endRound; ++round)
            {
                out.template segment<3>(cones.at(round)) = form.rounds[static_cast<std::size_t>(round)]
                                                               .template cast<Scalar>()
                                                               .transpose()
                                                               .lazyProduct(closing);
            }
        }
    };
    if (form.shares.empty())
    {
        close(0, static_cast<int>(form.groups.size()));
    }
    else
    {
        carryOut(static_cast<int>(form.shares.size()),
                 [&](int share, int) { close(form.shares[share].begin, form.shares[share].end); });
    }
    for (std::size_t limit = 0; limit < form.limits.size(); ++limit)
    {
        const typename Form<Rows>::Limit& at = form.limits[limit];
        const Scalar change = y[form.row(limit)];
        out.segment(form.entry(at), form.entries(at)).array() += Scalar(at.factor) * change;
        out[form.slack(limit)] = change;
    }
}

namespace
{

/// Of the entries of one group, as it acts on its first body.
template<int Rows, class Scalar>
ColumnOf<Rows, Scalar> forceOf(const Form<Rows>& form, const typename Form<Rows>::Group& group,
                               const ConeRanges& cones, const VectorOf<Scalar>& s)
{
    ColumnOf<Rows, Scalar> sum = ColumnOf<Rows, Scalar>::Zero();
    for (int ray = group.begin; ray < group.end; ++ray)
    {
        sum += rayOf<Rows, Scalar>(form, ray) * s[ray];
    }
    for (int round = group.beginRound; round < group.endRound; ++round)
    {
        sum += form.rounds[static_cast<std::size_t>(round)].template cast<Scalar>().lazyProduct(
            s.template segment<3>(cones.at(round)));
    }
    return sum;
}

template<int Rows, class Scalar>
void addForcesInTurn(const Form<Rows>& form, const VectorOf<Scalar>& s, VectorOf<Scalar>& out)
{
    const ConeRanges cones = form.cones();
    for (const typename Form<Rows>::Group& group : form.groups)
    {
        const ColumnOf<Rows, Scalar> sum = forceOf(form, group, cones, s);
        if (group.first < form.bodies)
        {
            out.template segment<Rows>(Rows * group.first) += onFirst<Rows, Scalar>(sum);
        }
        if (group.second < form.bodies)
        {
            out.template segment<Rows>(Rows * group.second) += onSecond<Rows, Scalar>(sum);
        }
    }
}

/// In shares for threads: what another share adds to as well is lent a place of its own until all are done.
template<int Rows, class Scalar>
void addForcesInShares(const Form<Rows>& form, const VectorOf<Scalar>& s, VectorOf<Scalar>& out)
{
    const ConeRanges cones = form.cones();
    VectorOf<Scalar> lent =
        VectorOf<Scalar>::Constant(Rows * static_cast<Eigen::Index>(form.lent.size()), Scalar(0));
    const auto add = [&](int place, const RowsOf<Rows, Scalar>& rows)
    {
        if (place < form.bodies)
        {
            out.template segment<Rows>(Rows * place) += rows;
        }
        else if (place > form.bodies)
        {
            lent.template segment<Rows>(Rows * (place - form.bodies - 1)) += rows;
        }
    };
    carryOut(static_cast<int>(form.shares.size()),
             [&](int share, int)
             {
                 for (int at = form.shares[share].begin; at < form.shares[share].end; ++at)
                 {
                     const ColumnOf<Rows, Scalar> sum = forceOf(form, form.groups[at], cones, s);
                     add(form.places[at][0], onFirst<Rows, Scalar>(sum));
                     add(form.places[at][1], onSecond<Rows, Scalar>(sum));
                 }
             });
    for (std::size_t place = 0; place < form.lent.size(); ++place)
    {
        out.template segment<Rows>(Rows * form.lent[place]) +=
            lent.template segment<Rows>(Rows * static_cast<Eigen::Index>(place));
    }
}

} // namespace

template<int Rows, class Scalar>
void addForces(const Form<Rows>& form, const VectorOf<Scalar>& s, VectorOf<Scalar>& out)
{
    if (form.shares.empty())
    {
        addForcesInTurn(form, s, out);
    }
    else
    {
        addForcesInShares(form, s, out);
    }
    for (std::size_t limit = 0; limit < form.limits.size(); ++limit)
    {
        const typename Form<Rows>::Limit& at = form.limits[limit];
        out[form.row(limit)] +=
            Scalar(at.factor) * s.segment(form.entry(at), form.entries(at)).sum() + s[form.slack(limit)];
    }
}

template<int Rows, class Scalar>
void addInertia(const Form<Rows>& form, const VectorOf<Scalar>& y, VectorOf<Scalar>& out)
{
    if (form.hasInertia())
    {
        for (int body = 0; body < form.bodies; ++body)
        {
            out.template segment<Rows>(Rows * body) +=
                form.inertia[body].template cast<Scalar>() * y.template segment<Rows>(Rows * body);
        }
    }
}

template void applyTransposed(const Form<3>&, const VectorOf<double>&, VectorOf<double>&);
template void addForces(const Form<3>&, const VectorOf<double>&, VectorOf<double>&);
template void addInertia(const Form<3>&, const VectorOf<double>&, VectorOf<double>&);
template void applyTransposed(const Form<3>&, const VectorOf<DoubleDouble>&, VectorOf<DoubleDouble>&);
template void addForces(const Form<3>&, const VectorOf<DoubleDouble>&, VectorOf<DoubleDouble>&);
template void addInertia(const Form<3>&, const VectorOf<DoubleDouble>&, VectorOf<DoubleDouble>&);
template void applyTransposed(const Form<6>&, const VectorOf<double>&, VectorOf<double>&);
template void addForces(const Form<6>&, const VectorOf<double>&, VectorOf<double>&);
template void addInertia(const Form<6>&, const VectorOf<double>&, VectorOf<double>&);
template void applyTransposed(const Form<6>&, const VectorOf<DoubleDouble>&, VectorOf<DoubleDouble>&);
template void addForces(const Form<6>&, const VectorOf<DoubleDouble>&, VectorOf<DoubleDouble>&);
template void addInertia(const Form<6>&, const VectorOf<DoubleDouble>&, VectorOf<DoubleDouble>&);

} // namespace drystone
