// The picture's colours follow the page's, light or dark, unless others have been chosen.
import type { Preview } from './preview';

const schemes = { light: 'Cornfield', dark: 'Tomorrow Night' };
const prefersDark = matchMedia('(prefers-color-scheme: dark)');

/** Returns the colour scheme that suits VS Code's theme, or else the browser's. */
export function schemeOfTheme(): string {
  const { classList } = document.body;
  const isLight = classList.contains('vscode-light') || classList.contains('vscode-high-contrast-light');
  const isDark = classList.contains('vscode-dark') || classList.contains('vscode-high-contrast');
  return schemes[!isLight && (isDark || prefersDark.matches) ? 'dark' : 'light'];
}

export function followTheme(preview: Preview): void {
  const follow = () => {
    const { colorscheme } = preview.wanted;
    const scheme = schemeOfTheme();
    if (Object.values(schemes).includes(colorscheme ?? '') && colorscheme !== scheme) preview.change({ colorscheme: scheme });
  };
  prefersDark.addEventListener('change', follow);
  new MutationObserver(follow).observe(document.body, { attributes: true, attributeFilter: ['class'] });
}
