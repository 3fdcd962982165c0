#ifndef rhombicInterpolatedField_h
#define rhombicInterpolatedField_h

#include "rhombicReferenceField.h"

#include "itkBSplineInterpolateImageFunction.h"
#include "itkImage.h"

namespace rhombic
{

/** \class InterpolatedField
 * \brief The cubic B-spline through the samples of a volume, mirrored at its border. */
class InterpolatedField : public ReferenceField
{
public:
  explicit InterpolatedField(const itk::Image<float, 3> * volume)
    : m_Spline(SplineType::New())
  {
    m_Spline->SetSplineOrder(3);
    m_Spline->SetInputImage(volume);
  }

  using ReferenceField::Evaluate;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override
  {
    SplineType::OutputType value;
    SplineType::CovariantVectorType derivative;
    const double coordinates[3]{ point[0], point[1], point[2] };
    m_Spline->EvaluateValueAndDerivative(itk::Point<double, 3>(coordinates), value, derivative);
    gradient = { derivative[0], derivative[1], derivative[2] };
    return value;
  }

private:
  using SplineType = itk::BSplineInterpolateImageFunction<itk::Image<float, 3>, double, double>;
  SplineType::Pointer m_Spline;
};

} // namespace rhombic

#endif
