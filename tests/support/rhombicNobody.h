#ifndef rhombicNobody_h
#define rhombicNobody_h

#include <unistd.h>

namespace rhombictest
{

/** \class Nobody
 * \brief While it lives, permissions bind this process, also when it is root's. */
class Nobody
{
public:
  Nobody()
    : m_User(geteuid())
    , m_IsBound(m_User != 0 || seteuid(65534) == 0)
  {}
  ~Nobody()
  {
    m_IsBound = seteuid(m_User) == 0;
  }
  Nobody(const Nobody &) = delete;
  Nobody &
  operator=(const Nobody &) = delete;

  bool
  IsBound() const
  {
    return m_IsBound;
  }

private:
  uid_t m_User;
  bool m_IsBound;
};

} // namespace rhombictest

#endif
