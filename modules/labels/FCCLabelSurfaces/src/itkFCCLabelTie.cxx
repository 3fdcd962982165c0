#include "itkFCCLabelTie.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace itk
{
namespace
{

using Coordinates = std::array<double, 4>;

/** Solves the rows a x = b of \a size equations, each row being a and b, by elimination with pivots. Returns whether
 * there is one solution. */
bool
Solve(double (&rows)[4][5], unsigned int size, Coordinates & solution)
{
  constexpr double singular = 1e-9; // weights are float32 of the size of 1
  for (unsigned int column = 0; column < size; ++column)
  {
    unsigned int pivot = column;
    for (unsigned int row = column + 1; row < size; ++row)
    {
      pivot = std::abs(rows[row][column]) > std::abs(rows[pivot][column]) ? row : pivot;
    }
    if (!(std::abs(rows[pivot][column]) > singular))
    {
      return false;
    }
    std::swap(rows[pivot], rows[column]);
    for (unsigned int row = 0; row < size; ++row)
    {
      const double factor = row == column ? 0.0 : rows[row][column] / rows[column][column];
      for (unsigned int n = column; factor != 0.0 && n <= size; ++n)
      {
        rows[row][n] -= factor * rows[column][n];
      }
    }
  }
  for (unsigned int n = 0; n < size; ++n)
  {
    solution[n] = rows[n][size] / rows[n][n];
  }
  return true;
}

} // namespace

std::array<double, 4>
FindFCCLabelTie(unsigned int size, const double (&weights)[4][4], double least)
{
  const unsigned int last = size - 1;
  double rows[4][5] = {};
  for (unsigned int site = 0; site < size; ++site)
  {
    for (unsigned int label = 0; label < last; ++label)
    {
      rows[label][site] = weights[site][label] - weights[site][last];
    }
    rows[last][site] = 1.0;
  }
  rows[last][size] = 1.0;
  const double middle = 1.0 / size;
  Coordinates found{};
  Coordinates point{};
  if (!Solve(rows, size, found))
  {
    std::fill_n(point.begin(), size, middle);
    return point;
  }
  double scale = 1.0; // of the way from the middle
  for (unsigned int n = 0; n < size; ++n)
  {
    scale = found[n] < least ? std::min(scale, (middle - least) / (middle - found[n])) : scale;
  }
  for (unsigned int n = 0; n < size; ++n)
  {
    point[n] = middle + scale * (found[n] - middle);
  }
  return point;
}

} // namespace itk
