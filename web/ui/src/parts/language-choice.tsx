import { t } from "../messages";
import { choose, LANGUAGES, type Language, language } from "../messages/language";

/** Each language by its own name. */
export function LanguageChoice() {
  return (
    <label class="language">
      <span>{t.header.language}</span>
      <select value={language} onChange={(event) => choose(event.currentTarget.value as Language)}>
        {Object.entries(LANGUAGES).map(([tag, name]) => (
          <option key={tag} value={tag} lang={tag}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}
