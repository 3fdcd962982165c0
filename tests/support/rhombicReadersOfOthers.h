#ifndef rhombicReadersOfOthers_h
#define rhombicReadersOfOthers_h

#include <vtkAppendPolyData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <filesystem>
#include <stdexcept>

namespace rhombictest
{

template <typename TReader>
vtkSmartPointer<vtkPolyData>
ReadWith(const std::filesystem::path & path)
{
  vtkNew<TReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

inline vtkSmartPointer<vtkPolyData>
ReadGLTF(const std::filesystem::path & path)
{
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkNew<vtkAppendPolyData> all;
  const auto blocks = vtkSmartPointer<vtkCompositeDataIterator>::Take(reader->GetOutput()->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    all->AddInputData(vtkPolyData::SafeDownCast(blocks->GetCurrentDataObject()));
  }
  all->Update();
  return all->GetOutput();
}

/** A surface file as VTK's reader of its format reads it: in mm, but GLB in metres with y up. */
inline vtkSmartPointer<vtkPolyData>
ReadWithVTK(const std::filesystem::path & path)
{
  const std::string extension = path.extension().string();
  return extension == ".stl"   ? ReadWith<vtkSTLReader>(path)
         : extension == ".ply" ? ReadWith<vtkPLYReader>(path)
         : extension == ".obj" ? ReadWith<vtkOBJReader>(path)
         : extension == ".vtp" ? ReadWith<vtkXMLPolyDataReader>(path)
         : extension == ".glb" ? ReadGLTF(path)
                               : throw std::invalid_argument(extension);
}

} // namespace rhombictest

#endif
