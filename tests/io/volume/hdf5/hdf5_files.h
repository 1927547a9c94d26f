// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Small HDF5 files of all kinds, written by the HDF5 library.
#pragma once

#include "io/hdf5/hdf5_file.h"
#include "tests/io/test_files.h"

namespace mw::io {

inline Hdf5Handle create_hdf5(const std::filesystem::path& path, bool latest = false,
                              hsize_t user_block = 0) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), &H5Pclose);
  if (latest) H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  H5Pset_userblock(creation.get(), user_block);
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), &H5Fclose};
}

/// How a data set is stored.
struct Hdf5Sample {
  std::vector<hsize_t> shape{3, 4, 5};
  VoxelType type = VoxelType::kU16;
  bool big = false;
  H5D_layout_t layout = H5D_CONTIGUOUS;
  std::vector<hsize_t> chunk{};
  std::vector<hsize_t> max_shape{};  ///< empty: it cannot grow
  bool shuffle = false;
  bool deflate = false;
  bool fletcher = false;
  std::optional<unsigned> other_filter{};  ///< one that the library does not have
  unsigned chunk_options = 0;
  std::optional<std::int64_t> fill{};
  std::optional<double> real_fill{};
};

inline hid_t stored_type(VoxelType type, bool big) {
  const std::array<hid_t, 20> types{H5T_STD_U8LE,   H5T_STD_U8BE,   H5T_STD_U16LE,  H5T_STD_U16BE,
                                    H5T_STD_U32LE,  H5T_STD_U32BE,  H5T_STD_U64LE,  H5T_STD_U64BE,
                                    H5T_STD_I8LE,   H5T_STD_I8BE,   H5T_STD_I16LE,  H5T_STD_I16BE,
                                    H5T_STD_I32LE,  H5T_STD_I32BE,  H5T_STD_I64LE,  H5T_STD_I64BE,
                                    H5T_IEEE_F32LE, H5T_IEEE_F32BE, H5T_IEEE_F64LE, H5T_IEEE_F64BE};
  return types[2 * static_cast<std::size_t>(type) + (big ? 1 : 0)];
}

/// The type of RawLabel for the library.
inline hid_t label_type(VoxelType type) {
  return is_signed(type) ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT64;
}

inline Hdf5Handle storage_of(const Hdf5Sample& sample) {
  Hdf5Handle list(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  H5Pset_layout(list.get(), sample.layout);
  if (!sample.chunk.empty()) {
    H5Pset_chunk(list.get(), static_cast<int>(sample.chunk.size()), sample.chunk.data());
    H5Pset_chunk_opts(list.get(), sample.chunk_options);
  }
  if (sample.shuffle) H5Pset_shuffle(list.get());
  if (sample.deflate) H5Pset_deflate(list.get(), 4);
  if (sample.fletcher) H5Pset_fletcher32(list.get());
  if (sample.other_filter) {
    H5Pset_filter(list.get(), static_cast<int>(*sample.other_filter), H5Z_FLAG_OPTIONAL, 0,
                  nullptr);
  }
  if (sample.fill) H5Pset_fill_value(list.get(), H5T_NATIVE_INT64, &*sample.fill);
  if (sample.real_fill) H5Pset_fill_value(list.get(), H5T_NATIVE_DOUBLE, &*sample.real_fill);
  return list;
}

/// Makes the data set and the groups on its way.
inline Hdf5Handle create_data_set(const Hdf5Handle& file, const std::string& path,
                                  const Hdf5Sample& sample) {
  const Hdf5Handle space(
      H5Screate_simple(static_cast<int>(sample.shape.size()), sample.shape.data(),
                       sample.max_shape.empty() ? nullptr : sample.max_shape.data()),
      &H5Sclose);
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), &H5Pclose);
  H5Pset_create_intermediate_group(links.get(), 1);
  const Hdf5Handle storage = storage_of(sample);
  Hdf5Handle set(H5Dcreate2(file.get(), path.c_str(), stored_type(sample.type, sample.big),
                            space.get(), links.get(), storage.get(), H5P_DEFAULT),
                 &H5Dclose);
  EXPECT_TRUE(set.valid()) << path;
  return set;
}

inline void write_data_set(const Hdf5Handle& file, const std::string& path,
                           const Hdf5Sample& sample, const std::vector<RawLabel>& labels) {
  const Hdf5Handle set = create_data_set(file, path, sample);
  EXPECT_GE(
      H5Dwrite(set.get(), label_type(sample.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, labels.data()),
      0);
}

/// Labels that the type holds: whole numbers for floats.
inline std::vector<RawLabel> labels_of(const Hdf5Sample& sample) {
  Index3 shape{1, 1, 1};
  for (const hsize_t extent : sample.shape) shape.x *= static_cast<std::int64_t>(extent);
  return sample_labels(shape, is_float(sample.type) ? VoxelType::kI8 : sample.type);
}

/// An attribute of numbers.  owner: a path in the file.
inline void write_attribute(const Hdf5Handle& file, const std::string& owner, const char* name,
                            const std::vector<double>& numbers) {
  const Hdf5Handle object(H5Oopen(file.get(), owner.c_str(), H5P_DEFAULT), &H5Oclose);
  const hsize_t size = numbers.size();
  const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), &H5Sclose);
  const Hdf5Handle attribute(
      H5Acreate2(object.get(), name, H5T_IEEE_F32BE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
      &H5Aclose);
  EXPECT_GE(H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, numbers.data()), 0);
}

inline void write_text_attribute(const Hdf5Handle& file, const std::string& owner, const char* name,
                                 const std::string& text, bool variable = false) {
  const Hdf5Handle object(H5Oopen(file.get(), owner.c_str(), H5P_DEFAULT), &H5Oclose);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type.get(), variable ? H5T_VARIABLE : text.size());
  const Hdf5Handle attribute(
      H5Acreate2(object.get(), name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
  const char* const data = text.c_str();
  const void* const value = variable ? static_cast<const void*>(&data) : data;
  EXPECT_GE(H5Awrite(attribute.get(), type.get(), value), 0);
}

}  // namespace mw::io
