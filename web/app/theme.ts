// Light, dark, or as the system has it; kept in the browser.

export type Theme = 'system' | 'light' | 'dark'

const KEY = 'groundstate-theme'

export function theme(): Theme {
  const kept = localStorage.getItem(KEY)
  return kept === 'light' || kept === 'dark' ? kept : 'system'
}

export function setTheme(next: Theme): void {
  if (next === 'system') {
    localStorage.removeItem(KEY)
    delete document.documentElement.dataset['theme']
  } else {
    localStorage.setItem(KEY, next)
    document.documentElement.dataset['theme'] = next
  }
}

export const following: Record<Theme, Theme> = { system: 'light', light: 'dark', dark: 'system' }
