// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Describes type, storage and filters of an HDF5 data set, by the library.
#include "io/volume/hdf5/describe_apart.h"

#include <algorithm>
#include <array>

#include "io/file/errors.h"
#include "io/file/wall/apart.h"
#include "io/hdf5/hdf5_file.h"
#include "io/volume/decode.h"

namespace mw::io {
namespace {

std::optional<Hdf5NumberType> integer(hid_t type) {
  const std::size_t size = H5Tget_size(type);
  const bool whole_bytes = H5Tget_precision(type) == 8 * size && H5Tget_offset(type) == 0;
  if (!whole_bytes || (size != 1 && size != 2 && size != 4 && size != 8)) return {};
  const H5T_order_t order = H5Tget_order(type);
  if (size > 1 && order != H5T_ORDER_LE && order != H5T_ORDER_BE) return {};
  const H5T_sign_t sign = H5Tget_sign(type);
  if (sign != H5T_SGN_NONE && sign != H5T_SGN_2) return {};
  return Hdf5NumberType{integer_type(static_cast<int>(size), sign == H5T_SGN_2),
                        order == H5T_ORDER_BE ? ByteOrder::kBig : ByteOrder::kLittle};
}

std::optional<Hdf5NumberType> floating(hid_t type) {
  if (H5Tequal(type, H5T_IEEE_F32LE) > 0) return Hdf5NumberType{VoxelType::kF32};
  if (H5Tequal(type, H5T_IEEE_F64LE) > 0) return Hdf5NumberType{VoxelType::kF64};
  if (H5Tequal(type, H5T_IEEE_F32BE) > 0) return Hdf5NumberType{VoxelType::kF32, ByteOrder::kBig};
  if (H5Tequal(type, H5T_IEEE_F64BE) > 0) return Hdf5NumberType{VoxelType::kF64, ByteOrder::kBig};
  return {};
}

const char* class_text(H5T_class_t kind) {
  switch (kind) {
    case H5T_INTEGER:
      return "integers of odd bits";
    case H5T_FLOAT:
      return "odd floats";
    case H5T_STRING:
      return "strings";
    case H5T_COMPOUND:
      return "compound";
    case H5T_BITFIELD:
      return "bit fields";
    case H5T_VLEN:
      return "lists";
    default:
      return "no numbers";
  }
}

}  // namespace

std::optional<Hdf5NumberType> number_type(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  if (kind == H5T_FLOAT) return floating(type);
  if (kind == H5T_INTEGER) return integer(type);
  if (kind != H5T_ENUM) return {};
  const Hdf5Handle base(H5Tget_super(type), &H5Tclose);
  return base.valid() ? integer(base.get()) : std::nullopt;
}

std::optional<std::vector<Hdf5Filter>> hdf5_filters(hid_t list) {
  std::vector<Hdf5Filter> out;
  const int count = H5Pget_nfilters(list);
  for (int i = 0; i < count; ++i) {
    unsigned flags = 0, parameter = 0;
    std::size_t parameters = 1;
    const H5Z_filter_t id = H5Pget_filter2(list, static_cast<unsigned>(i), &flags, &parameters,
                                           &parameter, 0, nullptr, nullptr);
    if (id < 0) return std::nullopt;
    out.push_back({static_cast<std::uint32_t>(id), parameter});
  }
  return out;
}

std::string type_text(hid_t type) {
  const auto number = number_type(type);
  return number ? name(number->type) : class_text(H5Tget_class(type));
}

namespace {

/// A compact data set is part of a header message, which has a size of 16 bits.
constexpr std::uint64_t kMaxCompactBytes = 1 << 16;
/// How many chunks of the grid a slow processor finds in a second.
constexpr std::uint64_t kChunksPerSecond = 20'000;
constexpr std::uint64_t kSecondsBeside = 5;

class Describer {
 public:
  Describer(Hdf5Source& source, hid_t hdf5, const std::string& path)
      : source_(source), hdf5_(hdf5) {
    out_.path = path;
    set_ = Hdf5Handle(H5Dopen2(hdf5, path.c_str(), H5P_DEFAULT), &H5Dclose);
    if (!set_.valid()) fail_library("cannot be opened");
  }

  [[nodiscard]] Hdf5Description describe() {
    check_place();
    find_type();
    find_shape();
    const Hdf5Handle list(H5Dget_create_plist(set_.get()), &H5Pclose);
    if (!list.valid()) fail_library("its storage is unknown");
    switch (H5Pget_layout(list.get())) {
      case H5D_COMPACT:
        find_bytes();
        break;
      case H5D_CONTIGUOUS:
        find_run();
        break;
      case H5D_CHUNKED:
        find_chunks(list.get());
        break;
      default:
        fail("its storage is unknown", kHdf5Damaged);
    }
    find_geometry(hdf5_, set_.get(), source_.bytes->name(), out_);
    return std::move(out_);
  }

 private:
  /// Offsets mean nothing in other files.
  void check_place() const {
    if (const auto found = stored_elsewhere(hdf5_, set_.get())) fail(found->reason, found->way_out);
  }

  void find_type() {
    type_ = Hdf5Handle(H5Dget_type(set_.get()), &H5Tclose);
    if (!type_.valid()) fail_library("its type is unknown");
    const auto number = number_type(type_.get());
    if (!number) {
      fail(text("holds ", type_text(type_.get()), ", labels are numbers"),
           "write the labels as integers of 8 to 64 bits");
    }
    out_.type = number->type;
    out_.order = number->order;
  }

  void find_shape() {
    const Hdf5Handle space(H5Dget_space(set_.get()), &H5Sclose);
    std::array<hsize_t, H5S_MAX_RANK> shape{};
    const int rank = H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
    if (rank < 0) fail_library("its shape is unknown");
    if (rank == 0) fail("it is a single number or empty", "a volume has 3 axes [z, y, x]");
    out_.shape.assign(shape.begin(), shape.begin() + rank);
  }

  void find_bytes() {
    out_.layout = Hdf5Layout::kCompact;
    auto bytes = static_cast<std::uint64_t>(byte_size(out_.type));
    for (const std::uint64_t extent : out_.shape) {
      if (extent > kMaxCompactBytes || (bytes *= extent) > kMaxCompactBytes) {
        fail("its shape does not fit its storage", kHdf5Damaged);
      }
    }
    out_.bytes.resize(bytes);
    if (bytes > 0 &&
        H5Dread(set_.get(), type_.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, out_.bytes.data()) < 0) {
      fail_library("cannot be read");
    }
  }

  void find_run() {
    out_.layout = Hdf5Layout::kContiguous;
    const haddr_t offset = H5Dget_offset(set_.get());
    if (offset == HADDR_UNDEF) {
      fail("it has no voxels in the file: nothing was written", "write the labels");
    }
    out_.offset = offset;
  }

  void find_chunks(hid_t list) {
    out_.layout = Hdf5Layout::kChunked;
    std::array<hsize_t, H5S_MAX_RANK> shape{};
    const int rank = H5Pget_chunk(list, shape.size(), shape.data());
    if (rank != static_cast<int>(out_.shape.size()))
      fail("its chunks have other axes", kHdf5Damaged);
    out_.chunk_shape.assign(shape.begin(), shape.begin() + rank);
    find_filters(list);
    find_fill(list);
    note_chunks();
  }

  void find_filters(hid_t list) {
    unsigned options = 0;
    H5Pget_chunk_opts(list, &options);
    out_.edges_unfiltered = (options & H5D_CHUNK_DONT_FILTER_PARTIAL_CHUNKS) != 0;
    const auto filters = hdf5_filters(list);
    if (!filters) fail_library("its filters are unknown");
    out_.filters = *filters;
  }

  void find_fill(hid_t list) {
    out_.fill.assign(static_cast<std::size_t>(byte_size(out_.type)), '\0');
    H5D_fill_value_t status = H5D_FILL_VALUE_UNDEFINED;
    if (H5Pfill_value_defined(list, &status) < 0 || status != H5D_FILL_VALUE_USER_DEFINED) return;
    if (H5Pget_fill_value(list, type_.get(), out_.fill.data()) < 0) {
      fail_library("its fill value is unknown");
    }
  }

  /// Returns the number of chunks along each axis, and allows the time that they take.
  [[nodiscard]] std::vector<std::uint64_t> grid() const {
    std::vector<std::uint64_t> counts;
    std::uint64_t all = 1;
    for (std::size_t d = 0; d < out_.shape.size(); ++d) {
      const std::uint64_t extent = out_.shape[d], chunk = out_.chunk_shape[d];
      if (chunk == 0) fail("a chunk is empty", kHdf5Damaged);
      counts.push_back(extent / chunk + (extent % chunk == 0 ? 0 : 1));
      if (__builtin_mul_overflow(all, counts.back(), &all) || all > kMaxHdf5Chunks) {
        fail(text("it is in more than ", kMaxHdf5Chunks, " chunks"),
             "h5repack it into larger ones: -l CHUNK=64x64x64");
      }
    }
    allow_cpu_seconds(kSecondsBeside + all / kChunksPerSecond);
    return counts;
  }

  void note_chunks() {
    const Hdf5Handle space(H5Dget_space(set_.get()), &H5Sclose);
    hsize_t stored = 0;
    if (H5Dget_num_chunks(set_.get(), space.get(), &stored) < 0) {
      fail_library("its index of chunks cannot be read");
    }
    note_grid();
    if (out_.chunks.size() != stored) {
      fail(text("its index of chunks has ", stored, ", of which ", out_.chunks.size(),
                " can be found"),
           kHdf5Damaged);
    }
  }

  void note_grid() {
    const std::vector<std::uint64_t> counts = grid();
    std::vector<std::uint64_t> chunk(counts.size(), 0);
    const bool empty = std::find(counts.begin(), counts.end(), 0) != counts.end();
    for (std::uint64_t number = 0; !empty; ++number) {
      note_chunk(chunk, number);
      std::size_t axis = counts.size();
      while (axis > 0 && ++chunk[axis - 1] == counts[axis - 1]) chunk[--axis] = 0;
      if (axis == 0) return;
    }
  }

  void note_chunk(const std::vector<std::uint64_t>& chunk, std::uint64_t number) {
    std::array<hsize_t, H5S_MAX_RANK> corner{};
    for (std::size_t d = 0; d < chunk.size(); ++d) corner[d] = chunk[d] * out_.chunk_shape[d];
    // The library fails for a chunk that is not there; note_chunks() tells that from damage.
    hsize_t bytes = 0;
    const herr_t found = H5Dget_chunk_storage_size(set_.get(), corner.data(), &bytes);
    if (found < 0 || bytes == 0) return;
    source_.only_note_data = true;
    source_.noted.reset();
    std::uint32_t skipped = 0;
    char nothing = 0;  // the source only notes, so that nothing is written here
    const herr_t done = H5Dread_chunk(set_.get(), H5P_DEFAULT, corner.data(), &skipped, &nothing);
    source_.only_note_data = false;
    if (done < 0) fail_library("its index of chunks cannot be read");
    if (!source_.noted || source_.noted->bytes != bytes || bytes > UINT32_MAX) {
      fail("its index of chunks contradicts itself", kHdf5Damaged);
    }
    out_.chunks.push_back({.number = number,
                           .offset = source_.noted->offset,
                           .bytes = static_cast<std::uint32_t>(bytes),
                           .skipped = skipped});
  }

  [[noreturn]] void fail(std::string_view reason, const char* way_out) const {
    fail_input(source_.bytes->name(), text("data set ", out_.path), reason, way_out);
  }
  [[noreturn]] void fail_library(const char* what) const {
    fail(text(what, ": ", hdf5_reason()), kHdf5Damaged);
  }

  Hdf5Source& source_;
  hid_t hdf5_;
  Hdf5Handle set_;
  Hdf5Handle type_;
  Hdf5Description out_;
};

}  // namespace

Hdf5Description describe_data_set(Hdf5Source& source, hid_t hdf5, const std::string& path) {
  return Describer(source, hdf5, path).describe();
}

}  // namespace mw::io
