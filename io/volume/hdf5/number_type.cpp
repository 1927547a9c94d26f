// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Looks at a type of HDF5.
#include "io/volume/hdf5/number_type.h"

#include "io/file/errors.h"
#include "io/hdf5/hdf5_handle.h"
#include "io/volume/voxel_type.h"

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

std::string type_text(hid_t type) {
  const auto number = number_type(type);
  return number ? name(number->type) : class_text(H5Tget_class(type));
}

}  // namespace mw::io
