itk_module(LabelMaps
  DEPENDS RhombicCommon ScanIO ITKTransform
  DESCRIPTION "What a label map tells: colours that set labels that touch apart, and doubts that it belongs to a scan.")
