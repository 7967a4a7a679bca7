/** Light or dark: as the system has it, until it is switched here. */
export class Theme {
  readonly #system = matchMedia('(prefers-color-scheme: dark)');

  constructor(private readonly changed: () => void) {
    this.#system.addEventListener('change', () => this.#apply(this.#chosen));
    this.#apply(this.#chosen);
  }

  get isDark(): boolean {
    return document.documentElement.dataset.theme === 'dark';
  }

  toggle(): void {
    const chosen = this.isDark ? 'light' : 'dark';
    document.cookie = `aplomb-theme=${chosen}; SameSite=Strict; max-age=${400 * 24 * 3600}`; // storage is each port's own
    this.#apply(chosen);
  }

  get #chosen(): string | null {
    return /\baplomb-theme=(light|dark)\b/.exec(document.cookie)?.[1] ?? null;
  }

  #apply(chosen: string | null): void {
    document.documentElement.dataset.theme = chosen ?? (this.#system.matches ? 'dark' : 'light');
    this.changed();
  }
}
