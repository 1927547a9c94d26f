// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes of each format, byte by byte.
#pragma once

#include "tests/io/test_files.h"

namespace mw::io {

inline std::string npy_file(const std::string& descr, bool fortran, const std::string& shape,
                            const std::string& data, int version = 1) {
  std::string dict = "{'descr': '" + descr + "', 'fortran_order': " + (fortran ? "True" : "False");
  dict += ", 'shape': " + shape + ", }\n";
  std::string file = "\x93NUMPY";
  file += static_cast<char>(version);
  file += '\0';
  return file + number_bytes(dict.size(), version == 1 ? 2 : 4, false) + dict + data;
}

/// A NIfTI header that can be bent field by field.
struct NiftiSample {
  int version = 1;
  bool big = false;
  std::vector<std::int64_t> dim{3, 5, 4, 3, 1, 1, 1, 1};
  int datatype = 2;
  std::array<double, 4> pixdim{1, 0.5, -2, 3};
  double vox_offset = 0;  ///< 0: the least
  double slope = 1;
  double inter = 0;
  int qform_code = 0;
  int sform_code = 0;
  std::array<double, 3> quaternion{0, 0, 0};
  std::array<double, 3> qoffset{-1, -2, -3};
  std::array<std::array<double, 3>, 3> matrix{{{0.5, 0, 0}, {0, 2, 0}, {0, 0, 3}}};
  std::array<double, 3> translation{10, 20, 30};
  int xyzt_units = 0;
  std::string magic;

  [[nodiscard]] std::string header() const {
    const bool one = version == 1;
    std::string h(one ? 352 : 544, '\0');
    put(h, 0, number_bytes(one ? 348 : 540, 4, big));
    put(h, one ? 344 : 4, !magic.empty() ? magic : one ? "n+1" : "n+2");
    for (std::size_t i = 0; i < 8; ++i) {
      put(h, one ? 40 + 2 * i : 16 + 8 * i,
          number_bytes(static_cast<std::uint64_t>(dim[i]), one ? 2 : 8, big));
    }
    put(h, one ? 70 : 12, number_bytes(static_cast<std::uint64_t>(datatype), 2, big));
    for (std::size_t i = 0; i < 4; ++i) real(h, one ? 76 + 4 * i : 104 + 8 * i, pixdim[i]);
    const double offset = vox_offset == 0 ? static_cast<double>(h.size()) : vox_offset;
    if (one) {
      real(h, 108, offset);
    } else {
      put(h, 168, number_bytes(static_cast<std::uint64_t>(offset), 8, big));
    }
    real(h, one ? 112 : 176, slope);
    real(h, one ? 116 : 184, inter);
    put(h, one ? 254 : 348, number_bytes(static_cast<std::uint64_t>(sform_code), one ? 2 : 4, big));
    put(h, one ? 252 : 344, number_bytes(static_cast<std::uint64_t>(qform_code), one ? 2 : 4, big));
    put(h, one ? 123 : 500, number_bytes(static_cast<std::uint64_t>(xyzt_units), one ? 1 : 4, big));
    for (std::size_t i = 0; i < 3; ++i) {
      real(h, one ? 256 + 4 * i : 352 + 8 * i, quaternion[i]);
      real(h, one ? 268 + 4 * i : 376 + 8 * i, qoffset[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        real(h, one ? 280 + 16 * i + 4 * k : 400 + 32 * i + 8 * k, matrix[i][k]);
      }
      real(h, one ? 280 + 16 * i + 12 : 400 + 32 * i + 24, translation[i]);
    }
    return h;
  }

 private:
  static void put(std::string& h, std::size_t at, const std::string& bytes) {
    h.replace(at, bytes.size(), bytes);
  }
  void real(std::string& h, std::size_t at, double x) const {
    std::uint64_t bits = 0;
    if (version == 1) {
      const auto narrow = static_cast<float>(x);
      std::memcpy(&bits, &narrow, 4);
    } else {
      std::memcpy(&bits, &x, 8);
    }
    put(h, at, number_bytes(bits, version == 1 ? 4 : 8, big));
  }
};

}  // namespace mw::io
