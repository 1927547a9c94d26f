// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes meshes, the format chosen by extension.
#include "io/mesh/open_mesh.h"

#include <algorithm>
#include <array>
#include <functional>

#include "io/file/errors.h"
#include "io/file/source/inflated_source.h"
#include "io/mesh/abaqus/inp_writer.h"
#include "io/mesh/ansys/cdb_writer.h"
#include "io/mesh/exodus/exodus_writer.h"
#include "io/mesh/febio/febio_writer.h"
#include "io/mesh/gmsh/msh.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/grouped/periodic_pairs.h"
#include "io/mesh/lsdyna/k_writer.h"
#include "io/mesh/medit/medit.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/nastran/bdf_writer.h"
#include "io/mesh/pieces/pvtu.h"
#include "io/mesh/scratch_mesh.h"
#include "io/mesh/vtkhdf/vtkhdf.h"
#include "io/mesh/vtu/vtu.h"
#include "io/mesh/xdmf/xdmf_writer.h"

namespace mw::io {
namespace {

/// Wedges of no thickness that a format has a place for.
enum class WedgePlace : std::uint8_t {
  kNowhere,
  kSix,     ///< of six nodes, between tets of four
  kTwelve,  ///< also of twelve nodes, between tets of ten
};

/// One format: a file ending, how to read it, how to write it, and what it has a place for.  It is
/// read where `read` or `stream` is there, and written where `open` is.
struct MeshFormat {
  const char* extension;
  /// Reads it whole; null where `stream` is there.
  MeshData (*read)(const std::filesystem::path&) = nullptr;
  /// Reads it in bounded memory; null where `read` is there.
  void (*stream)(const std::filesystem::path&, MeshSink&) = nullptr;
  /// Opens a sink; null where it is written in another way (open_mesh_pieces()).
  std::unique_ptr<MeshSink> (*open)(const std::filesystem::path&, Element,
                                    const MeshExtras&) = nullptr;
  /// Endings of the files beside it, which replace its own ending; null behind the last.
  std::array<const char*, 4> beside{};
  bool corners_alone = false;  ///< tets have four nodes
  bool has_values = false;     ///< tets have numbers (MeshHeader::values)
  WedgePlace wedges = WedgePlace::kNowhere;
  bool has_text = false;  ///< numbers are written in two ways
  bool takes_materials = false;
  bool takes_deck = false;       ///< Deck::kStatic
  bool takes_cell_deck = false;  ///< those of a cell that repeats itself

  [[nodiscard]] bool is_read() const { return read != nullptr || stream != nullptr; }
  [[nodiscard]] bool is_written() const { return open != nullptr; }
  [[nodiscard]] bool has_wedges6() const { return wedges != WedgePlace::kNowhere; }
  [[nodiscard]] bool has_wedges12() const { return wedges == WedgePlace::kTwelve; }
  [[nodiscard]] bool has_wedges(Element element) const {
    return has_middles(element) ? has_wedges12() : has_wedges6();
  }
};

/// Opens a sink that writes corners alone.
template <class Sink>
std::unique_ptr<MeshSink> open_corners(const std::filesystem::path& path, Element element,
                                       const MeshExtras&) {
  if (element == Element::kTet4) return std::make_unique<Sink>(path);
  fail_usage(why_no_middles(path, false));
}

/// Opens a sink that writes tets of four nodes as they come.  It groups a mesh with wedges or
/// with nodes on edges before it writes cells.
template <class Sink>
std::unique_ptr<MeshSink> open_streamed(const std::filesystem::path& path, Element element,
                                        const MeshExtras& extras) {
  if (!has_middles(element) && !extras.wedges) return std::make_unique<Sink>(path);
  const auto sink = std::make_shared<Sink>(path, element);
  return std::make_unique<GroupedSink>(
      path.parent_path(), [sink](GroupedMesh& mesh) { write_cells(mesh, *sink); }, element);
}

/// Opens the files of a format that needs the whole mesh, which kWrite writes into them.
template <class Files, auto kWrite>
std::unique_ptr<MeshSink> open_grouped(const std::filesystem::path& path, Element element,
                                       const MeshExtras& extras) {
  const auto files = std::make_shared<Files>(path, extras);
  return std::make_unique<GroupedSink>(
      path.parent_path(), [files](GroupedMesh& mesh) { std::invoke(kWrite, *files, mesh); },
      element);
}

const std::array kFormats{
    MeshFormat{.extension = ".vtkhdf",
               .stream = &read_vtkhdf,
               .open = &open_streamed<VtkhdfSink>,
               .has_values = true,
               .wedges = WedgePlace::kTwelve},
    MeshFormat{.extension = ".vtu",
               .read = [](const auto& path) { return read_vtu(*open_bytes(path)); },
               .open = &open_streamed<VtuSink>,
               .has_values = true,
               .wedges = WedgePlace::kTwelve},
    MeshFormat{.extension = ".mesh",
               .read = [](const auto& path) { return read_medit(*open_bytes(path)); },
               .open = &open_corners<MeditSink>,
               .corners_alone = true},
    MeshFormat{.extension = ".msh",
               .read = &read_msh,
               .open = &open_grouped<MshFiles, &write_msh>,
               .beside = {".msh.labels.csv"},
               .has_values = true,
               .wedges = WedgePlace::kSix,
               .has_text = true,
               .takes_materials = true},
    MeshFormat{.extension = ".msh2",
               .read = &read_msh,
               .open = &open_grouped<MshFiles, &write_msh2>,
               .beside = {".msh2.labels.csv"},
               .has_values = true,
               .wedges = WedgePlace::kSix,
               .takes_materials = true},
    MeshFormat{.extension = ".exo",
               .open = &open_grouped<ExodusWriter, &ExodusWriter::write>,
               .beside = {".exo.labels.csv"},
               .has_values = true,
               .wedges = WedgePlace::kSix,
               .takes_materials = true},
    MeshFormat{.extension = ".bdf",
               .open = &open_grouped<TabledFile, &write_bdf>,
               .beside = {".bdf.labels.csv"}},
    MeshFormat{.extension = ".inp",
               .open = &open_grouped<InpWriter, &InpWriter::write>,
               .wedges = WedgePlace::kSix,
               .takes_materials = true,
               .takes_deck = true,
               .takes_cell_deck = true},
    MeshFormat{.extension = ".xdmf",
               .open = &open_grouped<XdmfWriter, &XdmfWriter::write>,
               .beside = {".h5", ".cells.xdmf", ".facets.csv", ".xdmf.labels.csv"},
               .has_values = true},
    MeshFormat{.extension = ".k",
               .open = &open_grouped<TabledFile, &write_k>,
               .beside = {".k.labels.csv"}},
    MeshFormat{.extension = ".cdb",
               .open = &open_grouped<TabledFile, &write_cdb>,
               .beside = {".cdb.labels.csv"}},
    MeshFormat{.extension = ".feb",
               .open = &open_grouped<TabledFile, &write_feb>,
               .beside = {".feb.labels.csv"},
               .takes_deck = true},
    MeshFormat{.extension = kPiecesExtension, .read = &read_pvtu},
};

const MeshFormat* find_format(const std::filesystem::path& path) {
  for (const MeshFormat& format : kFormats) {
    if (path.extension() == format.extension) return &format;
  }
  return nullptr;
}

/// Returns the endings of the formats that `has` holds for, as ".vtkhdf, .vtu".
template <class Has>
std::string extensions_where(Has has) {
  std::string out;
  for (const MeshFormat& format : kFormats) {
    if (std::invoke(has, format)) out += (out.empty() ? "" : ", ") + text(format.extension);
  }
  return out;
}

/// Returns advice for a known ending that is no mesh's, or nothing.
std::string other_way(const std::string& extension) {
  if (extension == ".vtk") return "; .vtu is what came after .vtk";
  const bool is_surface = extension == ".stl" || extension == ".ply" || extension == ".obj";
  return is_surface ? "; surfaces of a mesh are written by 'mwmesh surface MESH -o FILE.stl'" : "";
}

Error unknown_format(const std::filesystem::path& path, const std::string& supported,
                     const std::string& way_out) {
  return {ErrorKind::kUsage,
          text(path.string(), ": extension '", path.extension().string(),
               "' is no mesh format known here; supported are ", supported, way_out)};
}

const MeshFormat& written_format(const std::filesystem::path& path) {
  const MeshFormat* const format = find_format(path);
  if (format == nullptr) {
    throw unknown_format(path, mesh_extensions(), other_way(path.extension().string()));
  }
  if (format->is_written()) return *format;
  fail_usage(path.string(), ": a mesh in pieces; write it whole, and then with 'convert ",
             "--pieces N'");
}

const MeshFormat& read_format(const std::filesystem::path& path) {
  const MeshFormat* const format = find_format(path);
  if (format == nullptr) {
    const std::string way = other_way(path.extension().string());
    throw unknown_format(path, read_mesh_extensions(),
                         way.empty() ? "; if it is a volume, mesh it first: mwmesh mesh" : way);
  }
  if (format->is_read()) return *format;
  fail_usage(path.string(), ": ", format->extension,
             " is written here, but not read; meshes are read from ", read_mesh_extensions());
}

/// Throws, because CalculiX, which runs the jobs, has no cohesive elements.
[[noreturn]] void refuse_wedges_in_deck(const std::filesystem::path& path) {
  fail_usage(path.string(), ": --deck has no sections for cohesive wedges; give --split in ",
             "the place of --cohesive");
}

/// Opens what writes a file, for a mesh with wedges or without.
using OpenFile = std::function<std::unique_ptr<MeshSink>(bool has_wedges)>;

/// Writes a file, and the pairs of nodes into one of their own.  It settles what only the mesh's
/// header tells: whether there are wedges, and whether the tets are parts of curved ones.
class FileSink : public MeshSink {
 public:
  struct File {
    std::filesystem::path path;
    Element element;
    MeshExtras extras;
    OpenFile open;
  };

  explicit FileSink(File file) : file_(std::move(file)) {
    const std::filesystem::path& pairs = file_.extras.pairs;
    if (!pairs.empty()) {
      below_[1] =
          std::make_unique<GroupedSink>(file_.path.parent_path(), open_pairs(pairs), file_.element);
    }
    below_[0] = file_.open(file_.extras.wedges);
  }

  void begin(const MeshHeader& header) override {
    settle(header);
    MeshHeader written = header;
    if (splits(header) && written.record.promises) written.record.promises->quality_floor = 0;
    each([&](MeshSink& sink) { sink.begin(written); });
  }
  void write_vertices(std::span<const Position> positions) override {
    each([&](MeshSink& sink) { sink.write_vertices(positions); });
  }
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override {
    each([&](MeshSink& sink) { sink.write_tets(tets, labels); });
  }
  void write_values(std::span<const double> rows) override {
    each([&](MeshSink& sink) { sink.write_values(rows); });
  }
  void finish() override {
    each([&](MeshSink& sink) { sink.finish(); });
  }
  void take(ScratchMesh& mesh, const std::function<void()>& between) override {
    if (splits(mesh.header())) return MeshSink::take(mesh, between);
    settle(mesh.header());
    each([&](MeshSink& sink) { sink.take(mesh, between); });
  }
  [[nodiscard]] std::uint64_t buffer_bytes() const override {
    std::uint64_t out = 0;
    each([&](const MeshSink& sink) { out += sink.buffer_bytes(); });
    return out;
  }

 private:
  template <class Visit>
  void each(Visit visit) const {
    for (const auto& sink : below_) {
      if (sink) visit(*sink);
    }
  }
  /// True if parts of curved tets are written as tets of their own, which do not hold the floor.
  [[nodiscard]] bool splits(const MeshHeader& header) const {
    return header.in_parts && file_.element != Element::kCurvedTet10;
  }
  void settle(const MeshHeader& header) {
    if (!header.record.cohesive.any()) return;
    require_place_for_wedges(file_.path, file_.element);
    if (file_.extras.deck != Deck::kNone) refuse_wedges_in_deck(file_.path);
    if (file_.extras.wedges) return;
    below_[0].reset();
    below_[0] = file_.open(true);
  }

  File file_;
  std::array<std::unique_ptr<MeshSink>, 2> below_;  ///< of the mesh, and of pairs if there are any
};

}  // namespace

std::string mesh_extensions() {
  return extensions_where(&MeshFormat::is_written);
}

std::string read_mesh_extensions() {
  return extensions_where(&MeshFormat::is_read);
}

bool is_read_mesh_path(const std::filesystem::path& path) {
  const MeshFormat* const format = find_format(path);
  return format != nullptr && format->is_read();
}

bool takes_static_deck(const std::filesystem::path& path) {
  const MeshFormat* const format = find_format(path);
  return format != nullptr && format->takes_deck;
}

bool is_mesh_path(const std::filesystem::path& path) {
  return find_format(path) != nullptr;
}

void require_place_for_values(const std::filesystem::path& path) {
  static_cast<void>(written_format(path));
  if (const std::string why = why_no_values(path); !why.empty()) {
    fail_usage(why);
  }
}

std::string why_no_values(const std::filesystem::path& path) {
  const MeshFormat* const format = find_format(path);
  if (format == nullptr || format->has_values || !format->is_written()) return {};
  return text(path.string(), ": ", format->extension, " has no place for values of tets; ",
              extensions_where(&MeshFormat::has_values), " have, and ",
              extensions_where(&MeshFormat::takes_materials), " take sets by --materials");
}

std::string why_no_middles(const std::filesystem::path& path, bool has_wedges) {
  const MeshFormat* const format = find_format(path);
  if (format == nullptr) return {};
  if (format->corners_alone || !format->is_written()) {
    return text(path.string(), ": ", format->extension, " is written with tet4 only");
  }
  if (!has_wedges || format->has_wedges12()) return {};
  return text(path.string(), ": ", format->extension, " has wedges of six nodes only");
}

void require_place_for_wedges(const std::filesystem::path& path, Element element) {
  const MeshFormat* const format = find_format(path);
  const bool is_known = format != nullptr;
  if (is_known && format->is_written() && format->has_wedges(element)) return;
  const bool quadratic = has_middles(element);
  const bool would_take_six = is_known && quadratic && format->has_wedges6();
  fail_usage(path.string(), ": ", path.extension().string(), " has no place for cohesive wedges",
             would_take_six ? " between tets of ten nodes; " : "; ",
             extensions_where(quadratic ? &MeshFormat::has_wedges12 : &MeshFormat::has_wedges6),
             " have", would_take_six ? ", or write tets of four" : "");
}

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> out{path};
  const MeshFormat* const format = find_format(path);
  if (format == nullptr) return out;
  for (const char* ending : format->beside) {
    if (ending != nullptr) out.push_back(std::filesystem::path(path).replace_extension(ending));
  }
  return out;
}

std::vector<std::filesystem::path> mesh_sources(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> out = mesh_files(path);
  if (path.extension() != kPiecesExtension) return out;
  try {
    const std::vector<std::filesystem::path> pieces = piece_files(path);
    out.insert(out.end(), pieces.begin(), pieces.end());
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kResource) throw;
  }
  return out;
}

MeshData read_mesh(const std::filesystem::path& path) {
  const MeshFormat& format = read_format(path);
  if (format.read != nullptr) return format.read(path);
  MeshDataSink sink;
  format.stream(path, sink);
  return std::move(sink.mesh());
}

void copy_mesh(const std::filesystem::path& path, MeshSink& sink) {
  const MeshFormat& format = read_format(path);
  if (format.stream != nullptr) {
    format.stream(path, sink);
  } else {
    write_mesh(format.read(path), sink);
  }
}

std::unique_ptr<MeshSink> open_mesh_sink(const std::filesystem::path& path, Element element,
                                         const MeshExtras& extras) {
  const MeshFormat& format = written_format(path);
  if (extras.encoding == Encoding::kText && !format.has_text) {
    fail_usage(path.string(), ": ", format.extension,
               " is written in one way, so ascii is not for it");
  }
  if (extras.materials && !format.takes_materials) {
    fail_usage(path.string(), ": has no place for materials; ",
               extensions_where(&MeshFormat::takes_materials), " have");
  }
  const bool has_deck = extras.deck != Deck::kNone;
  const auto takes =
      extras.deck == Deck::kStatic ? &MeshFormat::takes_deck : &MeshFormat::takes_cell_deck;
  if (has_deck && !(format.*takes)) {
    fail_usage(path.string(), ": no such job is written in ", format.extension,
               "; this --deck is for ", extensions_where(takes));
  }
  if (has_deck && extras.wedges) refuse_wedges_in_deck(path);
  const OpenFile open = [&format, path, element, extras](bool has_wedges) {
    MeshExtras taken = extras;
    taken.wedges = has_wedges;
    return format.open(path, element, taken);
  };
  return std::make_unique<FileSink>(FileSink::File{path, element, extras, open});
}

std::unique_ptr<MeshSink> open_mesh_pieces(const std::filesystem::path& path,
                                           std::uint64_t pieces) {
  if (path.extension() != kPiecesExtension) {
    fail_usage(path.string(), ": pieces are written as ", kPiecesExtension, " and files beside it");
  }
  if (pieces == 0) fail_usage(path.string(), ": no pieces are no mesh");
  const OpenFile open = [path, pieces](bool) { return std::make_unique<PvtuSink>(path, pieces); };
  return std::make_unique<FileSink>(FileSink::File{path, Element::kTet4, {}, open});
}

}  // namespace mw::io
