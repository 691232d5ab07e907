// What many files need of Eigen's matrices of doubles, compiled once: products, triangles, reflections,
// eigenvalues. It says nothing that Eigen does not say itself, and changes no result; each file that uses a
// matrix compiles so much less. Included with the precompiled headers, by no file of ours.
#pragma once

#include <Eigen/Dense>

#ifndef VEGARD_EIGEN_INSTANCE
#define VEGARD_EIGEN_INSTANCE extern template
#endif

// The inner parts of Eigen are not the same in every version.
#if EIGEN_VERSION_AT_LEAST(3, 4, 0) && !EIGEN_VERSION_AT_LEAST(3, 4, 90)
namespace Eigen {

// Reflections, the eigenvalues of symmetric matrices, factors.
VEGARD_EIGEN_INSTANCE void internal::tridiagonalization_inplace<MatrixXd, VectorXd>(MatrixXd&, VectorXd&);
VEGARD_EIGEN_INSTANCE ComputationInfo internal::computeFromTridiagonal_impl<MatrixXd, VectorXd, VectorXd>(
    VectorXd&, VectorXd&, const Index, bool, MatrixXd&);
VEGARD_EIGEN_INSTANCE void HouseholderSequence<MatrixXd, VectorXd, 1>::evalTo<MatrixXd, VectorXd>(
    MatrixXd&, VectorXd&) const;
VEGARD_EIGEN_INSTANCE bool
internal::ldlt_inplace<Lower>::unblocked<MatrixXd, Transpositions<Dynamic, Dynamic, int>, VectorXd>(
    MatrixXd&, Transpositions<Dynamic, Dynamic, int>&, VectorXd&, internal::SignMatrix&);
VEGARD_EIGEN_INSTANCE void
internal::apply_block_householder_on_the_left<Block<MatrixXd>, Block<MatrixXd>, VectorBlock<const VectorXd>>(
    Block<MatrixXd>&, const Block<MatrixXd>&, const VectorBlock<const VectorXd>&, bool);
VEGARD_EIGEN_INSTANCE class ColPivHouseholderQR<MatrixXd>;
VEGARD_EIGEN_INSTANCE class PartialPivLU<MatrixXd>;

namespace internal {

using ColumnsConst = const_blas_data_mapper<double, Index, ColMajor>;
using RowsConst = const_blas_data_mapper<double, Index, RowMajor>;
using ProductOfDoubles = gebp_traits<double, double>;

// Products of matrices.
VEGARD_EIGEN_INSTANCE struct gebp_kernel<double, double, Index,
                                         blas_data_mapper<double, Index, ColMajor, 0, 1>,
                                         ProductOfDoubles::mr, ProductOfDoubles::nr, false, false>;
VEGARD_EIGEN_INSTANCE struct general_matrix_matrix_product<Index, double, ColMajor, false, double, ColMajor,
                                                           false, ColMajor, 1>;
VEGARD_EIGEN_INSTANCE struct general_matrix_matrix_product<Index, double, RowMajor, false, double, ColMajor,
                                                           false, ColMajor, 1>;
VEGARD_EIGEN_INSTANCE struct general_matrix_matrix_product<Index, double, ColMajor, false, double, RowMajor,
                                                           false, ColMajor, 1>;

// Products of a matrix and a vector.
VEGARD_EIGEN_INSTANCE struct general_matrix_vector_product<Index, double, RowsConst, RowMajor, false, double,
                                                           ColumnsConst, false, 0>;
VEGARD_EIGEN_INSTANCE struct general_matrix_vector_product<Index, double, RowsConst, RowMajor, false, double,
                                                           RowsConst, false, 1>;
VEGARD_EIGEN_INSTANCE struct general_matrix_vector_product<Index, double, ColumnsConst, ColMajor, false,
                                                           double, RowsConst, false, 0>;
VEGARD_EIGEN_INSTANCE struct general_matrix_vector_product<Index, double, ColumnsConst, ColMajor, false,
                                                           double, ColumnsConst, false, 0>;
VEGARD_EIGEN_INSTANCE struct selfadjoint_matrix_vector_product<double, Index, ColMajor, Lower, false, false,
                                                               0>;

// Products with triangles, and their solutions.
VEGARD_EIGEN_INSTANCE struct product_triangular_matrix_matrix<double, Index, Upper, true, RowMajor, false,
                                                              ColMajor, false, ColMajor, 1, 0>;
VEGARD_EIGEN_INSTANCE struct product_triangular_matrix_matrix<double, Index, UnitUpper, true, RowMajor, false,
                                                              ColMajor, false, ColMajor, 1, 0>;
VEGARD_EIGEN_INSTANCE struct product_triangular_matrix_matrix<double, Index, Lower, true, ColMajor, false,
                                                              ColMajor, false, ColMajor, 1, 0>;
VEGARD_EIGEN_INSTANCE struct product_triangular_matrix_matrix<double, Index, UnitLower, true, ColMajor, false,
                                                              ColMajor, false, ColMajor, 1, 0>;
VEGARD_EIGEN_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor,
                                                     ColMajor, 1>;
VEGARD_EIGEN_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor,
                                                     ColMajor, 1>;
VEGARD_EIGEN_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, UnitUpper, false, RowMajor,
                                                     ColMajor, 1>;

}  // namespace internal
}  // namespace Eigen
#endif
