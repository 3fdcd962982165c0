#ifndef rhombicComparedMethod_h
#define rhombicComparedMethod_h

#include "rhombicReferenceField.h"

#include "itkImage.h"
#include "itkTriangleSurface.h"

#include <functional>
#include <string>
#include <vector>

namespace rhombic
{

/** A box whose sides are along the axes. */
struct FieldBox
{
  Vector3 lower;
  Vector3 upper;
};

/** A field on a Cartesian grid that covers a box, from its lower corner. */
itk::Image<float, 3>::Pointer
SampleBox(const ReferenceField & field, const FieldBox & box, double spacing);

/** The number of a method's samples, and the function that makes their surface at 0. */
struct PreparedMethod
{
  itk::SizeValueType samples = 0;
  std::function<itk::TriangleSurface::Pointer()> extract;
};

/** A lattice and how its surface is made. Samples cover the box, from its lower corner; of FCC and BCC every second row
 * begins or ends up to a spacing inside. */
struct ComparedMethod
{
  std::string name;
  std::string lattice; ///< "Cartesian", "FCC" or "BCC"
  /** \param density samples per unit of volume, above 0 */
  std::function<PreparedMethod(const ReferenceField & field, const FieldBox & box, double density)> prepare;
};

/** The Cartesian methods, the five modes on FCC, and tetrahedra, octahedra and hexahedra on BCC. */
const std::vector<ComparedMethod> &
GetComparedMethods();

/** The method of a name. Throws Failure(Usage), which lists the names, when there is none. */
const ComparedMethod &
GetComparedMethod(const std::string & name);

/** The density at which a method has the number of samples nearest to \a samples in a box. */
double
DensityOfSamples(const ComparedMethod & method, const FieldBox & box, double samples);

/** The true surface of a field, by vtkFlyingEdges3D on a grid of a spacing, with the points moved onto the field's
 * surface. */
itk::TriangleSurface::Pointer
MakeTrueSurface(const ReferenceField & field, const FieldBox & box, double spacing);

/** A sphere whose points are on it, from a tetrahedron whose sides are bisected \a bisections times: 4^(1 + bisections)
 * triangles. */
itk::TriangleSurface::Pointer
MakeBisectedSphere(const Vector3 & center, double radius, unsigned int bisections);

} // namespace rhombic

#endif
