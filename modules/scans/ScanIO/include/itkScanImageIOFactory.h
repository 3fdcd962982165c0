#ifndef itkScanImageIOFactory_h
#define itkScanImageIOFactory_h

#include "itkObjectFactoryBase.h"

namespace itk
{

/** \class ScanImageIOFactory
 * \brief Makes ScanImageIO known to ImageFileReader.
 *
 * Thread safety: that of ObjectFactoryBase: register before other threads read images.
 *
 * \ingroup ScanIO
 */
class ScanImageIOFactory : public ObjectFactoryBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ScanImageIOFactory);

  using Self = ScanImageIOFactory;
  using Superclass = ObjectFactoryBase;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkFactorylessNewMacro(Self);
  itkTypeMacro(ScanImageIOFactory, ObjectFactoryBase);

  const char *
  GetITKSourceVersion() const override;

  const char *
  GetDescription() const override;

  /** Registers a factory before all others, ITK's own among them, whenever it is called: ImageFileReader takes the
   * first class that can read a file. Only one factory of this class stays registered. */
  static void
  RegisterOneFactory();

protected:
  ScanImageIOFactory();
  ~ScanImageIOFactory() override = default;
};

} // namespace itk

#endif
