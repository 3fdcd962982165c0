#ifndef itkOMEZarrImageIOFactory_h
#define itkOMEZarrImageIOFactory_h

#include "itkObjectFactoryBase.h"

namespace itk
{

/** \class OMEZarrImageIOFactory
 * \brief Makes OMEZarrImageIO known to ImageFileReader.
 *
 * Thread safety: that of ObjectFactoryBase: register before other threads read images.
 *
 * \ingroup OMEZarr
 */
class OMEZarrImageIOFactory : public ObjectFactoryBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(OMEZarrImageIOFactory);

  using Self = OMEZarrImageIOFactory;
  using Superclass = ObjectFactoryBase;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkFactorylessNewMacro(Self);
  itkTypeMacro(OMEZarrImageIOFactory, ObjectFactoryBase);

  const char *
  GetITKSourceVersion() const override;

  const char *
  GetDescription() const override;

  /** Registers a factory unless one of this class is registered. */
  static void
  RegisterOneFactory();

protected:
  OMEZarrImageIOFactory();
  ~OMEZarrImageIOFactory() override = default;
};

} // namespace itk

#endif
