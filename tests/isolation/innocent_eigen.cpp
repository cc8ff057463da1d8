// Tasks with Eigen's small fixed-size algebra, which reach nothing but their own.
#include <Eigen/Dense>

#include "tests/isolation/task.h"

namespace {

using Matrix3 = Eigen::Matrix3d;
using Vector3 = Eigen::Vector3d;

TASK(Products, { out.out = ((Matrix3::Identity() * in.in) * Matrix3::Ones() * Vector3(1, 2, in.in)).sum(); })
TASK(Rotations, {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(in.in, Vector3::UnitZ()));
  out.out = (q.toRotationMatrix() * Vector3::UnitX()).y() + (q * Vector3::UnitX()).x() + q.normalized().w();
})
TASK(Slerp, {
  const Eigen::Quaterniond a(Eigen::AngleAxisd(in.in, Vector3::UnitZ())), b(1, 0, 0, 0);
  out.out = a.slerp(0.3, b).angularDistance(b);
})
TASK(Inverse, { out.out = (Matrix3::Identity() * (1 + in.in)).inverse().trace(); })
TASK(Inverse4, { out.out = (Eigen::Matrix4d::Identity() * (1 + in.in)).inverse().determinant(); })
TASK(Cross, { out.out = Vector3(in.in, 1, 2).cross(Vector3(3, in.in, 1)).normalized().norm(); })
TASK(Solve, { out.out = (Matrix3::Identity() * (1 + in.in)).ldlt().solve(Vector3(1, 2, 3)).sum(); })
// may be rejected at -O0: the way of large matrices, which allocates, is still in the code
TASK(Cholesky, { out.out = (Matrix3::Identity() * (1 + in.in)).llt().solve(Vector3(1, 2, 3)).sum(); })
TASK(Arrays, { out.out = (Eigen::Array4d(in.in, 1, 2, 3).square() + 1).log().maxCoeff(); })
TASK(Blocks, {
  Eigen::Matrix<double, 6, 6> all = Eigen::Matrix<double, 6, 6>::Constant(in.in);
  all.topLeftCorner<3, 3>() = all.bottomRightCorner<3, 3>().transpose() * 2;
  all.diagonal().array() += 1;
  out.out = all.sum();
})
TASK(Kalman, {
  Eigen::Matrix<double, 2, 2> P = Eigen::Matrix<double, 2, 2>::Identity() * (1 + in.in);
  const Eigen::Matrix<double, 1, 2> H(1, 0);
  const Eigen::Matrix<double, 2, 1> K = P * H.transpose() / ((H * P * H.transpose())(0) + 0.1);
  P = (Eigen::Matrix<double, 2, 2>::Identity() - K * H) * P;
  out.out = P.trace();
})
TASK(EulerAngles, { out.out = Matrix3(Eigen::AngleAxisd(in.in, Vector3::UnitY())).eulerAngles(2, 1, 0).x(); })

}  // namespace

JAROL_PLUGIN(Products, Rotations, Slerp, Inverse, Inverse4, Cross, Solve, Cholesky, Arrays, Blocks, Kalman, EulerAngles)
