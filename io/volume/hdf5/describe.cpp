// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Describes an HDF5 data set in a child process, and checks what the child says.
#include "io/volume/hdf5/description.h"

#include <algorithm>
#include <functional>

#include "io/file/errors.h"
#include "io/file/wall/apart.h"
#include "io/hdf5/hdf5_file.h"
#include "io/volume/checks.h"
#include "io/volume/hdf5/describe_apart.h"

namespace mw::io {
namespace {

/// The most data sets that an error names.
constexpr std::size_t kMaxNamed = 12;

/// Returns the shape as the file has it.  H5Dget_space() would open the files of a virtual data
/// set, to see how far they reach.
Hdf5Handle space_of(hid_t set) {
  const Hdf5Handle list(H5Dget_create_plist(set), &H5Pclose);
  if (!list.valid()) return {};
  const bool is_virtual = H5Pget_layout(list.get()) == H5D_VIRTUAL;
  return {is_virtual ? H5Pget_virtual_vspace(list.get(), 0) : H5Dget_space(set), &H5Sclose};
}

Hdf5Entry entry_of(hid_t group, const char* name, std::string path) {
  Hdf5Entry entry{.path = std::move(path), .shape = {}, .type = "unreadable"};
  const Hdf5Handle set(H5Dopen2(group, name, H5P_DEFAULT), &H5Dclose);
  const Hdf5Handle type(set.valid() ? H5Dget_type(set.get()) : H5I_INVALID_HID, &H5Tclose);
  const Hdf5Handle space = set.valid() ? space_of(set.get()) : Hdf5Handle();
  if (!type.valid() || !space.valid()) return entry;
  std::vector<hsize_t> shape(H5S_MAX_RANK);
  const int rank = H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  entry.shape.assign(shape.begin(), shape.begin() + std::max(rank, 0));
  entry.type = type_text(type.get());
  const auto number = number_type(type.get());
  entry.is_integer = number && !is_float(number->type);
  return entry;
}

struct Visit {
  std::string below;  ///< the group with a slash behind it
  std::vector<Hdf5Entry> entries;
};

herr_t visit(hid_t group, const char* name, const H5O_info_t* info, void* data) {
  auto& found = *static_cast<Visit*>(data);
  if (info->type != H5O_TYPE_DATASET) return 0;
  found.entries.push_back(entry_of(group, name, found.below + name));
  return found.entries.size() < kMaxHdf5Entries ? 0 : 1;
}

using Fits = std::function<bool(const Hdf5Entry&)>;

std::vector<const Hdf5Entry*> all_that(const std::vector<Hdf5Entry>& entries, const Fits& fits) {
  std::vector<const Hdf5Entry*> found;
  for (const Hdf5Entry& entry : entries) {
    if (fits(entry)) found.push_back(&entry);
  }
  return found;
}

Fits is_named(const char* path) {
  return [path](const Hdf5Entry& entry) { return entry.path == path; };
}

bool is_feature_ids(const Hdf5Entry& entry) {
  return entry.path.ends_with("/FeatureIds") &&
         (entry.path.starts_with("/DataContainers/") || entry.path.starts_with("/DataStructure/"));
}

/// Fits data sets of integers with `count` axes that are longer than 1.
Fits has_axes(int count) {
  return [count](const Hdf5Entry& entry) {
    const auto longer = std::count_if(entry.shape.begin(), entry.shape.end(),
                                      [](std::uint64_t extent) { return extent > 1; });
    return entry.is_integer && longer == count;
  };
}

bool is_labels_of_cremi(const Hdf5Entry& entry) {
  return entry.path.starts_with("/volumes/labels/") && has_axes(3)(entry);
}

[[noreturn]] void fail_choice(std::string_view file, const char* reason,
                              const std::vector<const Hdf5Entry*>& among) {
  std::vector<Hdf5Entry> entries;
  for (const Hdf5Entry* entry : among) entries.push_back(*entry);
  fail_input(file, "HDF5 data sets", text(reason, ": ", list_text(entries)),
             "name one with --dataset");
}

}  // namespace

std::vector<Hdf5Entry> list_data_sets(hid_t hdf5, const std::string& group, std::string_view file) {
  Visit found{.below = group.ends_with('/') ? group : group + "/", .entries = {}};
  if (H5Ovisit_by_name2(hdf5, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, &visit, &found,
                        H5O_INFO_BASIC, H5P_DEFAULT) < 0) {
    fail_input(file, "HDF5 structure", text("cannot list the groups: ", hdf5_reason()),
               "the file is damaged: check it with h5dump -H");
  }
  return std::move(found.entries);
}

const std::string& choose_data_set(const std::vector<Hdf5Entry>& entries, std::string_view file) {
  const std::vector<Fits> conventions{is_named("/volumes/labels/neuron_ids"),
                                      is_labels_of_cremi,
                                      is_named("/exported_data"),
                                      is_feature_ids,
                                      has_axes(3),
                                      has_axes(2)};
  for (const Fits& fits : conventions) {
    const auto found = all_that(entries, fits);
    if (found.size() == 1) return found[0]->path;
    if (found.size() > 1) fail_choice(file, "several may hold the labels", found);
  }
  fail_choice(file, "none is an array of integers with 3 axes",
              all_that(entries, [](const Hdf5Entry&) { return true; }));
}

std::string list_text(const std::vector<Hdf5Entry>& entries) {
  if (entries.empty()) return "there is none";
  std::string out;
  for (std::size_t i = 0; i < std::min(entries.size(), kMaxNamed); ++i) {
    const Hdf5Entry& entry = entries[i];
    out += text(i == 0 ? "" : ", ", entry.path, " ", shape_text(entry.shape),
                entry.shape.empty() ? "" : " ", entry.type);
  }
  if (entries.size() > kMaxNamed) out += text(" and ", entries.size() - kMaxNamed, " more");
  return out;
}

namespace {

constexpr const char* kCheckFile = "the file is damaged: check it with h5dump, or h5repack it";

Hdf5Handle open_file(Hdf5Source& source, const std::string& name) {
  silence_hdf5();
  // A file may name filters that the library would load as plugins; none is needed.
  H5PLset_loading_state(0);
  const Hdf5Handle access = access_from(source);
  const hid_t hdf5 = H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.get());
  if (hdf5 < 0) {
    fail_input(name, "HDF5 structure", text("cannot be opened: ", hdf5_reason()),
               "the file is truncated, damaged or still being written (then h5clear -s it)");
  }
  return {hdf5, &H5Fclose};
}

/// Returns "/a/b" for "a/b/".
std::string full_path(const std::string& given) {
  std::string path = given.starts_with('/') ? given : "/" + given;
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  return path;
}

bool is_data_set(hid_t hdf5, const std::string& path) {
  const Hdf5Handle object(H5Oopen(hdf5, path.c_str(), H5P_DEFAULT), &H5Oclose);
  return object.valid() && H5Iget_type(object.get()) == H5I_DATASET;
}

bool is_group(hid_t hdf5, const std::string& path) {
  const Hdf5Handle object(H5Oopen(hdf5, path.c_str(), H5P_DEFAULT), &H5Oclose);
  return object.valid() && H5Iget_type(object.get()) == H5I_GROUP;
}

std::string find_data_set(hid_t hdf5, const std::string& wanted, const std::string& file) {
  if (wanted.empty()) {
    if (H5Lexists(hdf5, "VTKHDF", H5P_DEFAULT) > 0) {
      fail_input(file, "group VTKHDF", "the file is a mesh or an image of VTK, no labelled volume",
                 "give the voxels that it was made from, or name an array with --dataset");
    }
    return choose_data_set(list_data_sets(hdf5, "/", file), file);
  }
  std::string path = full_path(wanted);
  if (is_data_set(hdf5, path)) return path;
  if (is_group(hdf5, path)) return choose_data_set(list_data_sets(hdf5, path, file), file);
  fail_input(file, text("data set ", path),
             text("missing; there are: ", list_text(list_data_sets(hdf5, "/", file))),
             "name one of them with --dataset");
}

/// Describes a data set; this runs in the child.
std::string describe_here(const ByteSource& bytes, const std::string& wanted) {
  Hdf5Source source{.bytes = &bytes, .noted = {}};
  const Hdf5Handle hdf5 = open_file(source, bytes.name());
  const std::string path = find_data_set(hdf5.get(), wanted, bytes.name());
  return pack(describe_data_set(source, hdf5.get(), path));
}

class Checker {
 public:
  Checker(const ByteSource& source, const Hdf5Description& description)
      : source_(source), description_(description) {}

  void check() const {
    demand(!description_.path.empty() && !description_.shape.empty(), "it has no name or shape");
    if (description_.layout == Hdf5Layout::kContiguous) check_run();
    if (description_.layout == Hdf5Layout::kCompact) {
      demand(description_.bytes.size() == voxel_bytes(), "it is not as long as its shape needs");
    }
    if (description_.layout == Hdf5Layout::kChunked) check_chunks();
  }

 private:
  void check_run() const {
    const std::uint64_t size = source_.size();
    const std::uint64_t held = description_.offset < size ? size - description_.offset : 0;
    if (voxel_bytes() <= held) return;
    fail_input(
        source_.name(), text("data set ", description_.path),
        text("shape ", shape_text(description_.shape), " of ", name(description_.type), " needs ",
             voxel_bytes(), " bytes after offset ", description_.offset, ", the file holds ", held),
        kCheckFile);
  }

  void check_chunks() const {
    demand(description_.chunk_shape.size() == description_.shape.size(),
           "its chunks have other axes");
    for (const std::uint64_t extent : description_.chunk_shape) {
      demand(extent > 0, "a chunk is empty");
    }
    demand(description_.fill.size() == static_cast<std::size_t>(byte_size(description_.type)),
           "its fill value is no voxel");
    const std::uint64_t size = source_.size();
    std::uint64_t all = 0, next = 0;
    for (const Hdf5Chunk& chunk : description_.chunks) {
      demand(chunk.number >= next, "its chunks are out of order");
      demand(chunk.offset <= size && chunk.bytes <= size - chunk.offset,
             "a chunk is outside of the file");
      next = chunk.number + 1;
      all += chunk.bytes;
    }
    // Chunks that share their bytes would make a large volume of a small file.
    demand(all <= size, "its chunks overlap");
  }

  /// Returns the bytes of all voxels, or the most that 64 bits hold when they are more.
  [[nodiscard]] std::uint64_t voxel_bytes() const {
    auto bytes = static_cast<std::uint64_t>(byte_size(description_.type));
    for (const std::uint64_t extent : description_.shape) {
      if (__builtin_mul_overflow(bytes, extent, &bytes)) return UINT64_MAX;
    }
    return bytes;
  }

  void demand(bool met, const char* otherwise) const {
    if (met) return;
    fail_input(source_.name(), text("data set ", description_.path), otherwise, kCheckFile);
  }

  const ByteSource& source_;
  const Hdf5Description& description_;
};

}  // namespace

Hdf5Description describe_hdf5(const ByteSource& source, const std::string& data_set) {
  // A chunk takes at least a byte of the file.
  const std::uint64_t max_chunks = std::min<std::uint64_t>(kMaxHdf5Chunks, source.size());
  ApartLimits limits;
  limits.answer_bytes = kMaxPackedDescription + sizeof(Hdf5Chunk) * max_chunks;
  const ApartAnswer answer = run_apart(limits, [&] { return describe_here(source, data_set); });
  if (!answer.bytes) {
    fail_input(source.name(), "HDF5 structure",
               text("the HDF5 library could not read it: ", answer.death), kCheckFile);
  }
  std::optional<Hdf5Description> description = unpack_description(*answer.bytes);
  if (!description) {
    fail_input(source.name(), "HDF5 structure",
               "the HDF5 library could not read it: its answer is broken", kCheckFile);
  }
  check_description(source, *description);
  return std::move(*description);
}

void check_description(const ByteSource& source, const Hdf5Description& description) {
  Checker(source, description).check();
}

}  // namespace mw::io
