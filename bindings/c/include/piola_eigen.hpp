/*
 * Matrices of Eigen as piola has them: by rows, so that no product or sum can take one for its transpose.
 */
#ifndef PIOLA_EIGEN_HPP
#define PIOLA_EIGEN_HPP

#include <Eigen/Core>

#include "piola.hpp"

namespace piola {

/// A 3×3 matrix by rows. Eigen turns matrices by columns into it, and the other way round, where one is assigned
/// to the other.
template <class T>
using matrix3 = Eigen::Matrix<T, 3, 3, Eigen::RowMajor>;

/// A 9×9 matrix: dP/dF, with row and column 3i+j for entry (i, j).
template <class T>
using matrix9 = Eigen::Matrix<T, 9, 9, Eigen::RowMajor>;

/// The matrix of a point among nine numbers of each: F or P. Writing to it writes there.
template <class T>
Eigen::Map<matrix3<T>> matrix(span<T> numbers, std::size_t point) {
    return Eigen::Map<matrix3<T>>(numbers.data() + 9 * point);
}
template <class T>
Eigen::Map<const matrix3<T>> matrix(span<const T> numbers, std::size_t point) {
    return Eigen::Map<const matrix3<T>>(numbers.data() + 9 * point);
}
template <class T>
Eigen::Map<matrix3<T>> matrix(std::vector<T> &numbers, std::size_t point) {
    return matrix(span<T>(numbers), point);
}
template <class T>
Eigen::Map<const matrix3<T>> matrix(const std::vector<T> &numbers, std::size_t point) {
    return matrix(span<const T>(numbers), point);
}

/// The tangent of a point among 81 numbers of each.
template <class T>
Eigen::Map<const matrix9<T>> tangent(const std::vector<T> &numbers, std::size_t point) {
    return Eigen::Map<const matrix9<T>>(numbers.data() + 81 * point);
}

/// The numbers of a vector of matrices, for batches.
template <class T>
span<const T> numbers(const std::vector<matrix3<T>> &matrices) {
    static_assert(sizeof(matrix3<T>) == 9 * sizeof(T), "matrices have no gaps between them");
    return {matrices.empty() ? nullptr : matrices.front().data(), 9 * matrices.size()};
}
template <class T>
span<T> numbers(std::vector<matrix3<T>> &matrices) {
    static_assert(sizeof(matrix3<T>) == 9 * sizeof(T), "matrices have no gaps between them");
    return {matrices.empty() ? nullptr : matrices.front().data(), 9 * matrices.size()};
}

} // namespace piola

#endif
