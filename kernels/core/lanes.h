// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Four numbers at a time, with the same result on every machine.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "kernels/core/metric.h"

/// Compiles a function for wide registers too; the loader picks what fits the processor.  Lanes
/// never mix and nothing is fused, so all versions give the same bits.  (Clang and sanitizers do
/// not support this.)
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define MW_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define MW_WIDE
#endif

namespace mw {

inline constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
/// The result of a comparison: all bits of a lane are set where it holds, none elsewhere.  (How far
/// the compiler aligns these types depends on the processor that it compiles for, so they stay out
/// of what is kept in memory.)
using LaneMask = std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))));
using LaneInts = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));

struct Lanes3 {
  Lanes x, y, z;
};

/// Numbers of four lanes in memory.
using StoredInts = std::array<std::int32_t, kLanes>;
using StoredLanes = std::array<double, kLanes>;

// A function that an MW_WIDE function calls must be compiled along with it, hence always inline.
#define MW_LANES [[gnu::always_inline, nodiscard]] inline

MW_LANES Lanes lanes(double value) {
  return Lanes{value, value, value, value};
}
MW_LANES Lanes3 lanes(const Vec3& v) {
  return {lanes(v[0]), lanes(v[1]), lanes(v[2])};
}
MW_LANES LaneInts load(const StoredInts& s) {
  LaneInts v;
  std::memcpy(&v, s.data(), sizeof v);
  return v;
}
MW_LANES Lanes load(const StoredLanes& s) {
  Lanes v;
  std::memcpy(&v, s.data(), sizeof v);
  return v;
}
[[gnu::always_inline]] inline void store(const Lanes& values, StoredLanes& out) {
  std::memcpy(out.data(), &values, sizeof values);
}
[[gnu::always_inline]] inline void store(const LaneInts& values, StoredInts& out) {
  std::memcpy(out.data(), &values, sizeof values);
}
// Written lane by lane each of these is one instruction.  GCC makes several of
// __builtin_convertvector(), as it widens each half of the lanes apart.
MW_LANES Lanes to_lanes(const LaneInts& v) {
  return Lanes{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]),
               static_cast<double>(v[3])};
}
MW_LANES Lanes to_lanes(const StoredInts& s) {
  return Lanes{static_cast<double>(s[0]), static_cast<double>(s[1]), static_cast<double>(s[2]),
               static_cast<double>(s[3])};
}
MW_LANES LaneMask to_mask(const LaneInts& v) {
  return LaneMask{v[0], v[1], v[2], v[3]};
}
struct LaneInts3 {
  LaneInts x, y, z;
};

/// Takes the first three numbers of each, one from all four into a lane.
MW_LANES LaneInts3 transposed(const LaneInts& a, const LaneInts& b, const LaneInts& c,
                              const LaneInts& d) {
  const LaneInts xy_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                 xy_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                 z_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7),
                 z_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(xy_ab, xy_cd, 0, 1, 4, 5),
          __builtin_shufflevector(xy_ab, xy_cd, 2, 3, 6, 7),
          __builtin_shufflevector(z_ab, z_cd, 0, 1, 4, 5)};
}
/// Picks x, y or z in each lane, by the number of the axis there.
MW_LANES Lanes by_axis(const LaneInts& axes, const Lanes& x, const Lanes& y, const Lanes& z) {
  const LaneMask is_x = to_mask(axes == 0), is_y = to_mask(axes == 1);
  return is_x ? x : is_y ? y : z;
}
MW_LANES Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
MW_LANES Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
MW_LANES Lanes3 operator*(const Lanes& s, const Lanes3& v) {
  return {s * v.x, s * v.y, s * v.z};
}
MW_LANES Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// Takes the sum in the order in which Eigen adds.
MW_LANES Lanes eigen_dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + (a.y * b.y + a.z * b.z);
}
MW_LANES Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
MW_LANES Lanes root(const Lanes& v) {
  return Lanes{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
}
MW_LANES bool any(const LaneMask& m) {
#ifdef __SSE2__
  using Doubles = double __attribute__((vector_size(2 * sizeof(double))));
  const auto either = __builtin_shufflevector(m, m, 0, 1) | __builtin_shufflevector(m, m, 2, 3);
  return __builtin_ia32_movmskpd(std::bit_cast<Doubles>(either)) != 0;
#else
  return (m[0] | m[1] | m[2] | m[3]) != 0;
#endif
}
/// One bit for each lane, set where the comparison holds.
MW_LANES unsigned lane_bits(const LaneInts& m) {
#ifdef __SSE__
  using Floats = float __attribute__((vector_size(sizeof(LaneInts))));
  return static_cast<unsigned>(__builtin_ia32_movmskps(std::bit_cast<Floats>(m)));
#else
  return static_cast<unsigned>((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
#endif
}
/// Bits of four comparisons, the first in the lowest bits.
MW_LANES unsigned lane_bits(const LaneInts& a, const LaneInts& b, const LaneInts& c,
                            const LaneInts& d) {
#ifdef __SSE2__
  const auto low = __builtin_ia32_packssdw128(a, b), high = __builtin_ia32_packssdw128(c, d);
  return static_cast<unsigned>(__builtin_ia32_pmovmskb128(__builtin_ia32_packsswb128(low, high)));
#else
  return lane_bits(a) | lane_bits(b) << 4 | lane_bits(c) << 8 | lane_bits(d) << 12;
#endif
}
/// Adds the lanes in a fixed order.
MW_LANES double sum(const Lanes& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

}  // namespace mw
