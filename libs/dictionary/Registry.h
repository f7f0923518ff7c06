// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
/// Families of models that a dictionary chooses from by `type`, each family one list that can be read:
///
///     const Registry<Texture>& textureTypes()
///     {
///         static const Registry<Texture> registry{
///             "texture",
///             {model<Texture, RunningBond>("runningBond", "blocks of one size, joints in the middle",
///             makeWall),
///              model<Texture, Arch>("arch", "a circular arch of voussoirs", makeArch)}};
///         return registry;
///     }
///     const Texture texture = textureTypes().select(dictionary.subDict("texture"));
///
/// RunningBond is the structure of the model's settings, with a `declare` (dictionary/Options.h).
#pragma once

#include "dictionary/Options.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace drystone
{

/// One choice of a family.
template<class Made>
struct Model
{
    std::string name;    ///< what `type` says
    std::string summary; ///< one line
    std::function<Made(const Dictionary&)> read;
    std::function<std::vector<OptionDescription>()> describe;
};

/// \param family what the models are, in the singular, as in "Unknown texture type ..."
/// \param words models of the family
/// \throws FatalIOError always: the `type` of this dictionary is missing or unknown
[[noreturn]] void failSelection(const Dictionary& dictionary, const std::string& family,
                                const std::vector<std::string>& words);

/// A family of models.
template<class Made>
struct Registry
{
    std::string family; ///< in the singular: texture, contact law
    std::vector<Model<Made>> models;

    /// Make what the dictionary's `type` names from its other entries.
    /// \throws FatalIOError for an unknown type, or what is wrong with the entries
    Made select(const Dictionary& dictionary) const
    {
        std::vector<std::string> names;
        if (const Entry* type = dictionary.find("type"))
        {
            const auto name = type->template as<std::string>();
            for (const Model<Made>& model : models)
            {
                if (model.name == name)
                {
                    return model.read(dictionary);
                }
            }
        }
        for (const Model<Made>& model : models)
        {
            names.push_back(model.name);
        }
        failSelection(dictionary, family, names);
    }

    std::vector<OptionDescription::Alternative> describe() const
    {
        std::vector<OptionDescription::Alternative> alternatives;
        for (const Model<Made>& model : models)
        {
            alternatives.push_back({model.name, model.summary, model.describe()});
        }
        return alternatives;
    }
};

/// A model whose settings are a structure with a `declare`.
/// \param make from the settings, or from the settings and their dictionary (for the places of messages)
template<class Made, Declared Settings, class Make>
Model<Made> model(std::string name, std::string summary, Make make)
{
    return {std::move(name), std::move(summary),
            [make](const Dictionary& dictionary) -> Made
            {
                Settings settings{};
                Options options;
                options.readElsewhere({"type"});
                declare(options, settings);
                options.readFrom(dictionary);
                if constexpr (std::is_invocable_v<Make, Settings, const Dictionary&>)
                {
                    return make(std::move(settings), dictionary);
                }
                else
                {
                    return make(std::move(settings));
                }
            },
            [] { return describeOptions<Settings>(); }};
}

} // namespace drystone
