// What the pair passes see of the cell grid: where each cell's particles stand, and which runs of storage surround a cell.
#pragma once

#include <array>
#include <cstdint>

namespace bleedsim::sph {

/// A contiguous run of particles, and what to add to their coordinates (in support radii) to see them across a periodic side.
template <class Real>
struct NeighborRun {
  std::uint32_t begin, end;
  Real shift_x, shift_y, shift_z;
};

/// Row-major cells, x fastest; one layer of empty cells all round, so that no access needs a bounds check.
template <class Real>
struct GridView {
  static constexpr int kMaxRuns = 27;

  const std::uint32_t* start = nullptr;  ///< first particle of each cell; one entry more than cells
  std::array<int, 3> size{};             ///< cells per axis, the empty layers included
  std::array<bool, 3> periodic{};
  std::array<Real, 3> period{};  ///< side lengths in support radii, where periodic

  int rows() const { return size[1] * size[2]; }
  std::uint32_t rowBegin(int row) const { return start[static_cast<std::size_t>(row) * static_cast<std::size_t>(size[0])]; }
  std::uint32_t rowEnd(int row) const { return rowBegin(row + 1); }
  /// The end of as few rows from `row` on as hold `particles`, at most `end`.
  int rowsWith(std::uint32_t particles, int row, int end) const {
    const std::uint32_t first = rowBegin(row);
    while (row < end && rowBegin(row) - first < particles) ++row;
    return row;
  }
  std::size_t cell(int row, int x) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size[0]) + static_cast<std::size_t>(x);
  }

  /// The runs that hold every particle of the 27 cells around cell x of a row; returns their number.
  template <bool kPeriodic>
  int neighborRuns(int row, int x, NeighborRun<Real>* runs) const {
    int count = 0;
    if constexpr (!kPeriodic) {
      for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
          const std::size_t c = cell(row + dz * size[1] + dy, x);
          runs[count++] = {start[c - 1], start[c + 2], Real(0), Real(0), Real(0)};
        }
      }
    } else {
      const int y = row % size[1];
      const int z = row / size[1];
      for (int dz = -1; dz <= 1; ++dz) {
        Real shift_z;
        const int zz = wrapped(2, z + dz, shift_z);
        for (int dy = -1; dy <= 1; ++dy) {
          Real shift_y;
          const int yy = wrapped(1, y + dy, shift_y);
          const int neighbor_row = zz * size[1] + yy;
          const std::size_t c = cell(neighbor_row, x);
          runs[count++] = {start[c - 1], start[c + 2], Real(0), shift_y, shift_z};
          if (!periodic[0]) continue;
          // The cells beyond the side are the empty layer in the run above; their contents stand at the other end of the row.
          for (const int dx : {-1, 1}) {
            Real shift_x;
            const int xx = wrapped(0, x + dx, shift_x);
            if (shift_x == Real(0)) continue;
            const std::size_t w = cell(neighbor_row, xx);
            runs[count++] = {start[w], start[w + 1], shift_x, shift_y, shift_z};
          }
        }
      }
    }
    return count;
  }

 private:
  int wrapped(int axis, int c, Real& shift) const {
    const std::size_t a = static_cast<std::size_t>(axis);
    const int last = size[a] - 2;
    shift = Real(0);
    if (!periodic[a]) return c;
    if (c < 1) {
      shift = -period[a];
      return last;
    }
    if (c > last) {
      shift = period[a];
      return 1;
    }
    return c;
  }
};

}  // namespace bleedsim::sph
