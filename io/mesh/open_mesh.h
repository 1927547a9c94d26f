// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes meshes of every format there is, chosen by extension.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "io/mesh/element.h"
#include "io/mesh/mesh_data.h"
#include "io/mesh/mesh_extras.h"

namespace mw::io {

/// Returns the extensions that are written, as ".vtkhdf, .vtu, .mesh".
[[nodiscard]] std::string mesh_extensions();
/// Returns the extensions that are read, which include kPiecesExtension but not those of solvers.
[[nodiscard]] std::string read_mesh_extensions();
/// True if the extension is that of a mesh, even of one that is not read.
[[nodiscard]] bool is_mesh_path(const std::filesystem::path& path);

/// True if read_mesh() reads meshes with this extension.
[[nodiscard]] bool is_read_mesh_path(const std::filesystem::path& path);

/// Returns whether Deck::kStatic makes a job of a mesh in the format of this name.
[[nodiscard]] bool takes_static_deck(const std::filesystem::path& path);

/// ERRORS: mw::Error(kUsage) for a format that has no place for numbers of tets
/// (MeshHeader::values).
void require_place_for_values(const std::filesystem::path& path);
/// Returns what that error says; empty where there is a place, which meshes in pieces have, too.
[[nodiscard]] std::string why_no_values(const std::filesystem::path& path);

/// Returns why the middles of edges have no place in a mesh of that name, with wedges or without;
/// empty where they have one.
[[nodiscard]] std::string why_no_middles(const std::filesystem::path& path, bool has_wedges);

/// ERRORS: mw::Error(kUsage) for a format that has no place for wedges between tets of that kind.
void require_place_for_wedges(const std::filesystem::path& path, Element element);

/// Returns the files that are always written for a mesh of that name: that file, then those beside.
[[nodiscard]] std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path);

/// Returns the files that a mesh of that name is read from: mesh_files(), and the pieces that a
/// .pvtu names.  Pieces of a .pvtu that cannot be read are left out, as reading it says why.
[[nodiscard]] std::vector<std::filesystem::path> mesh_sources(const std::filesystem::path& path);

/// ERRORS: mw::Error(kUsage) for an extension that is unknown or written only; kInput with file and
/// place when missing, truncated, corrupt or not of tetrahedra.
[[nodiscard]] MeshData read_mesh(const std::filesystem::path& path);

/// Reads a mesh into a sink, from begin() to finish(); .vtkhdf in bounded memory, the others by way
/// of MeshData.
void copy_mesh(const std::filesystem::path& path, MeshSink& sink);

/// ERRORS: mw::Error(kUsage) for an unknown extension, an element that the format does not have, an
/// extra that it has no room for, or a path that cannot be written; begin() throws it for a mesh
/// with wedges that the format has no place for.  With materials it writes material_table_path()
/// beside the mesh, too.  ENSURES: a mesh that comes in the parts of curved tets has these tets
/// again with kCurvedTet10, and no quality floor in its record otherwise, as it was not that of
/// parts.
[[nodiscard]] std::unique_ptr<MeshSink> open_mesh_sink(const std::filesystem::path& path,
                                                       Element element = Element::kTet4,
                                                       const MeshExtras& extras = {});

/// The ending of meshes in pieces.
inline constexpr const char* kPiecesExtension = ".pvtu";
/// Opens a sink that writes tets of four nodes in pieces (pieces/pvtu.h), for programs that run on
/// many processes.
/// ERRORS: mw::Error(kUsage) for another extension or no pieces, or a path that cannot be written.
[[nodiscard]] std::unique_ptr<MeshSink> open_mesh_pieces(const std::filesystem::path& path,
                                                         std::uint64_t pieces);

}  // namespace mw::io
