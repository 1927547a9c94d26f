// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options about the files of meshes, shared by the commands that read or write one.
#pragma once

#include <filesystem>
#include <string>

#include "engine/cli/requests.h"
#include "io/names/label_names.h"

namespace mw::cli {

/// Adds --force, without which a command replaces no file of others (FileNames::require_own()).
void add_force_option(OptionSet& options, bool& force);

/// Adds the argument MESH; `what` says in the help what the command does with it.
void add_mesh_option(OptionSet& options, std::filesystem::path& mesh, const std::string& what);

/// Returns the names of labels in a mesh's file.  ERRORS: those of io::copy_mesh().
[[nodiscard]] io::LabelNames names_of(const std::filesystem::path& mesh);

/// Returns the names in a file of --names, and logs what was taken for what it leaves open.
[[nodiscard]] io::LabelNames names_in(const std::filesystem::path& file);

/// Returns the formats of such meshes, for the end of the help.
[[nodiscard]] std::string mesh_note();

}  // namespace mw::cli
