#ifndef rhombicDicomTags_h
#define rhombicDicomTags_h

#include "rhombicDicomHeader.h"

/** The elements that Rhombic reads from DICOM files, by their names in the standard (PS3.6). Other elements are
 * skipped. */
namespace rhombic::DicomTags
{

constexpr DicomTag ImageType = 0x00080008;
constexpr DicomTag SOPClassUID = 0x00080016;
constexpr DicomTag Modality = 0x00080060;
constexpr DicomTag FrameType = 0x00089007;
constexpr DicomTag EchoTime = 0x00180081;
constexpr DicomTag EchoNumbers = 0x00180086;
constexpr DicomTag EffectiveEchoTime = 0x00189082;
constexpr DicomTag MREchoSequence = 0x00189114;
constexpr DicomTag MRImageFrameTypeSequence = 0x00189226;
constexpr DicomTag CTImageFrameTypeSequence = 0x00189329;
constexpr DicomTag BodyPartExamined = 0x00180015;
constexpr DicomTag SliceThickness = 0x00180050;
constexpr DicomTag SpacingBetweenSlices = 0x00180088;
constexpr DicomTag SeriesInstanceUID = 0x0020000e;
constexpr DicomTag SeriesNumber = 0x00200011;
constexpr DicomTag AcquisitionNumber = 0x00200012;
constexpr DicomTag ImagePositionPatient = 0x00200032;
constexpr DicomTag ImageOrientationPatient = 0x00200037;
constexpr DicomTag TemporalPositionIdentifier = 0x00200100;
constexpr DicomTag StackID = 0x00209056;
constexpr DicomTag FrameContentSequence = 0x00209111;
constexpr DicomTag PlanePositionSequence = 0x00209113;
constexpr DicomTag PlaneOrientationSequence = 0x00209116;
constexpr DicomTag TemporalPositionIndex = 0x00209128;
constexpr DicomTag SamplesPerPixel = 0x00280002;
constexpr DicomTag PhotometricInterpretation = 0x00280004;
constexpr DicomTag NumberOfFrames = 0x00280008;
constexpr DicomTag Rows = 0x00280010;
constexpr DicomTag Columns = 0x00280011;
constexpr DicomTag PixelSpacing = 0x00280030;
constexpr DicomTag BitsAllocated = 0x00280100;
constexpr DicomTag BitsStored = 0x00280101;
constexpr DicomTag HighBit = 0x00280102;
constexpr DicomTag PixelRepresentation = 0x00280103;
constexpr DicomTag PixelPaddingValue = 0x00280120;
constexpr DicomTag PixelPaddingRangeLimit = 0x00280121;
constexpr DicomTag RescaleIntercept = 0x00281052;
constexpr DicomTag RescaleSlope = 0x00281053;
constexpr DicomTag ModalityLUTSequence = 0x00283000;
constexpr DicomTag PixelMeasuresSequence = 0x00289110;
constexpr DicomTag PixelValueTransformationSequence = 0x00289145;
constexpr DicomTag Units = 0x00541001;
constexpr DicomTag SegmentationType = 0x00620001;
constexpr DicomTag SegmentSequence = 0x00620002;
constexpr DicomTag SegmentNumber = 0x00620004;
constexpr DicomTag SegmentLabel = 0x00620005;
constexpr DicomTag SegmentIdentificationSequence = 0x0062000a;
constexpr DicomTag ReferencedSegmentNumber = 0x0062000b;
constexpr DicomTag RecommendedDisplayCIELabValue = 0x0062000d;
constexpr DicomTag SharedFunctionalGroupsSequence = 0x52009229;
constexpr DicomTag PerFrameFunctionalGroupsSequence = 0x52009230;
constexpr DicomTag PixelData = 0x7fe00010;

} // namespace rhombic::DicomTags

#endif
